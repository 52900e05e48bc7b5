// Built where MPI is not found.
#include <cstdlib>

#include "sim/failure.hpp"
#include "sim/team.hpp"

namespace sim {

std::unique_ptr<Team> join_team() {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (size != nullptr && std::string(size) != "1")
    throw Failure(ExitCode::environment,
                  "cannot share the run out to " + std::string(size) +
                      " processes (built without MPI) install libopenmpi-dev and build again, or "
                      "use --shard");
  return nullptr;
}

}  // namespace sim
