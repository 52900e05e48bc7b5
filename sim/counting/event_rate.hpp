#pragma once
// How often something happens that may come by chance, in a rhythm or in bursts, from stretches of
// time that know nothing of each other.
#include <cstdint>

#include "sim/counting/statistics.hpp"

namespace sim {

/// Events of equal stretches. In integers, so that the order of adding changes nothing.
struct EventSums {
  std::uint64_t stretches = 0, events = 0, squared = 0;  // the last: of each stretch's events
};

/// Events an hour (or whatever `exposure`, of all stretches together, is in), with the interval of
/// poisson_rate for as many events as would come by chance and scatter so much: events / (variance
/// over mean), by Student's t for so many stretches less one. That is Korn and Graubard's (1998)
/// way with ratios. What comes in a rhythm scatters less than by chance, so its interval is
/// narrower; what comes in bursts has a wider one. Of one stretch, or of no event, nothing is seen
/// of a scatter: then it is that of poisson_rate.
Estimate event_rate(const EventSums& sums, double exposure, double level);

}  // namespace sim
