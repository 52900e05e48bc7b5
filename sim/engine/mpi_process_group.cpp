// Built where MPI is found.
#include <mpi.h>

#include <cstdint>
#include <cstdlib>
#include <exception>
#include <limits>
#include <numeric>
#include <utility>

#include "sim/engine/process_group.hpp"
#include "sim/failure.hpp"

namespace sim {
namespace {

/// Whatever fails in MPI ends the whole job with its own words (MPI_ERRORS_ARE_FATAL).
class MpiTeam : public ProcessGroup {
 public:
  MpiTeam() {
    int given = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  }
  MpiTeam(const MpiTeam&) = delete;
  MpiTeam& operator=(const MpiTeam&) = delete;
  /// A failure is told before the job ends: at the end of this process.
  ~MpiTeam() override {
    if (std::uncaught_exceptions() == 0 || in_order_)
      MPI_Finalize();
    else
      std::atexit([] { MPI_Abort(MPI_COMM_WORLD, static_cast<int>(ExitCode::environment)); });
  }

  int size() const override { return size_; }
  int rank() const override { return rank_; }

  std::vector<std::string> exchange(const std::string& mine) override {
    std::vector<int> sizes(static_cast<std::size_t>(size_)), begins;
    const int size = static_cast<int>(mine.size());
    MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD);
    const std::int64_t total = std::accumulate(sizes.begin(), sizes.end(), std::int64_t{0});
    if (total > std::numeric_limits<int>::max())
      throw Failure(ExitCode::environment,
                    "what the processes counted is too much to exchange use shards and merge");
    int end = 0;
    for (const int of_one : sizes) begins.push_back(std::exchange(end, end + of_one));
    std::string all(static_cast<std::size_t>(end), '\0');
    MPI_Allgatherv(mine.data(), size, MPI_BYTE, all.data(), sizes.data(), begins.data(), MPI_BYTE,
                   MPI_COMM_WORLD);
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < sizes.size(); ++i)
      parts.push_back(
          all.substr(static_cast<std::size_t>(begins[i]), static_cast<std::size_t>(sizes[i])));
    return parts;
  }

  bool any(bool mine) override {
    const int one = mine ? 1 : 0;
    int all = 0;
    MPI_Allreduce(&one, &all, 1, MPI_INT, MPI_LOR, MPI_COMM_WORLD);
    return all != 0;
  }

  void end_in_order() override {
    in_order_ = true;
    MPI_Barrier(MPI_COMM_WORLD);
  }

  double largest(double mine) override {
    double all = 0;
    MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return all;
  }

 private:
  int size_ = 1, rank_ = 0;
  bool in_order_ = false;
};

}  // namespace

/// Open MPI, MPICH and Slurm's srun set one of these for the processes that they start. Starting
/// MPI in any other process would cost it half a second.
std::unique_ptr<ProcessGroup> join_process_group() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"})
    if (std::getenv(name) != nullptr) return std::make_unique<MpiTeam>();
  return nullptr;
}

}  // namespace sim
