#include "sim/engine/engine_options.hpp"

namespace sim {

PointResult as_point(const GroupResult& sum, StopReason stop, const Link& link, double elapsed_s) {
  return {.operating = link.operating,
          .tally = sum.tally,
          .stop = stop,
          .elapsed_s = elapsed_s,
          .simulated_s = sum.simulated_s,
          .n_samples = sum.n_samples,
          .outside = link.outside,
          .profile = sum.profile};
}

}  // namespace sim
