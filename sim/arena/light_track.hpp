#pragma once
// What light of each sender gets to the receiver along its way.
#include <atomic>
#include <vector>

#include "dsp/units.hpp"
#include "sim/arena/sender.hpp"
#include "sim/arena/trajectory.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Effective irradiance at the module, peak of the on/off wave, mW/m2, at even steps of time; a
/// straight line between. One number: it never changes.
struct LightTrack {
  dsp::Seconds step;
  std::vector<float> irradiance;

  double at(dsp::Seconds t) const;
  double highest() const;
  double mean() const;
};

/// `scenario` has its module as it is under its conditions (sim/link's module_of). LED and module
/// come no nearer than 30 mm: they have bodies. `step`: that of the track, which covers [0, end]
/// and a step more. The direct light and the floor's image are worked out at each step; what the
/// floor scatters, at most some per cent of it (1 % from 1 m on at 10 mm height), only as often as
/// keeps a straight line within 0.5 % of all. Worth nothing once `*stop` is true: it then gives up
/// soon.
LightTrack light_track(const Scenario& scenario, const Sender& sender, const Trajectory& way,
                       dsp::Seconds end, dsp::Seconds step,
                       const std::atomic<bool>* stop = nullptr);

}  // namespace sim
