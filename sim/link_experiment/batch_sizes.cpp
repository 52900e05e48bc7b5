#include "sim/link_experiment/batch_sizes.hpp"

#include <algorithm>

#include "channel/chain.hpp"
#include "channel/instruction_set.hpp"
#include "dsp/units.hpp"
#include "sim/trial/trial.hpp"

namespace sim {

BatchSizes batch_sizes(const Link& link) {
  constexpr std::uint32_t quick = 64 * group_size;
  if (link.decisions) return {quick, quick};
  const auto lanes = static_cast<std::uint32_t>(channel::trials_at_once());
  if (link.envelope || link.importance) return {lanes, lanes};
  constexpr double samples_a_batch = 0x1p28;
  const double samples = dsp::cycles(mean_length(link), link.chain.sample_rate) * group_size;
  const auto groups = static_cast<std::uint64_t>(samples_a_batch / samples);
  const auto most = std::clamp<std::uint64_t>(groups * group_size, lanes, 8 * lanes);
  return {lanes, static_cast<std::uint32_t>(most)};
}

}  // namespace sim
