#include "sim/shared_link/shared_link_experiment.hpp"

#include "channel/instruction_set.hpp"

namespace sim {
namespace {

void describe_shared_link(SharedLinkPoint& point, const SharedLinkSetup& setup,
                          const SharedLinkTally& tally) {
  point.irradiance_mw_per_m2 = setup.irradiance_mw_per_m2;
  point.reflected_mw_per_m2 = setup.reflected_mw_per_m2;
  point.validity_flags = setup.validity_flags;
  point.tally = tally;
}

}  // namespace

constinit const Measurement<SharedLinkSetup, SharedLinkTally, SharedLinkPoint>
    shared_link_measurement{
        .unreached =
            [](const Scenario&, const SourceLocations&, const std::vector<double>& coordinates) {
              return SharedLinkPoint{.coordinates = coordinates};
            },
        .prepare = [](const Scenario& s, const SourceLocations&,
                      const Workers&) { return make_shared_link(s); },
        .most_at_once = [](const SharedLinkSetup&, std::uint32_t,
                           int) { return static_cast<std::uint32_t>(channel::trials_at_once()); },
        .run = run_shared_link,
        .ratio = [](const SharedLinkSetup&, const SharedLinkTally& tally,
                    double level) { return cautious_ratio(tally.losses, level); },
        .describe = describe_shared_link,
        .fits =
            [](const SharedLinkSetup&, const SharedLinkTally& tally, std::uint32_t n) {
              return tally.n_runs == n && tally.losses.is_sound() &&
                     tally.direction[0].losses.is_sound() && tally.direction[1].losses.is_sound();
            }};

}  // namespace sim
