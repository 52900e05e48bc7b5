// Built where MPI is not found.
#include <cstdlib>

#include "sim/engine/process_group.hpp"
#include "sim/failure.hpp"

namespace sim {

std::unique_ptr<ProcessGroup> join_process_group() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    const char* size = std::getenv(name);
    if (size != nullptr && std::string(size) != "1")
      throw Failure(ExitCode::environment,
                    "cannot share the run out to " + std::string(size) +
                        " processes (built without MPI) install libopenmpi-dev and build again, "
                        "or use --shard");
  }
  return nullptr;
}

}  // namespace sim
