// Sixteen links at once.
#include "reference_lanes.hpp"

namespace bench {
inline namespace COSYS_ISA {

std::unique_ptr<ReferenceChain> make() {
  return std::make_unique<KeyedLinks<InBlocks<LaneLinks<dsp::Lanes8>>>>();
}

}  // namespace COSYS_ISA
}  // namespace bench
