// That the variants of the reference chain do the same job.
#include <cmath>

#include "gtest/gtest.h"
#include "reference_chain.hpp"
#include "reference_lanes.hpp"

namespace bench {
namespace {

/// Within 99.9 % (3.29 sigma) of counting statistics, and 0.5 %, which is what one sample later or
/// earlier makes. Errors come a little in clusters, as the peak tracker remembers 120 bits: of the
/// counts in 1000 bits, variance over mean is 1.03 to 1.1, where a binomial law has 0.98.
TEST(ReferenceChain, EveryVariantHasTheBitErrorRate) {
  constexpr double clustering = 1.1;
  for (const ReferenceVariant& variant : reference_variants()) {
    const auto chain = variant.make();
    chain->run(100);  // the peak tracker begins at zero
    const auto tally = chain->run(20000);
    const auto bits = static_cast<double>(tally.bits);
    const double counting = 3.29 * std::sqrt(clustering * reference_ber / bits);
    EXPECT_NEAR(static_cast<double>(tally.errors) / bits, reference_ber,
                counting + 0.005 * reference_ber)
        << variant.name;
  }
}

/// The noise of one of the two links of LaneLinks<float>.
template <std::uint32_t which>
class LaneNormals {
 public:
  LaneNormals() { source_.seed(0, dsp::RandomAddress{.seed = 1, .trial = which}.block(0)); }
  void fill(float* normals) { source_.fill(normals, block); }

 private:
  dsp::NormalSource<float> source_;
};

/// Same noise, same bytes: the receiver of the lanes decides as the plain one does, at the same
/// sample. Rounding differs, so a bit in thousands that is read while it changes may.
TEST(ReferenceChain, LanesDecideAsThePlainReceiver) {
  InBlocks<LaneLinks<float>> lanes;
  InBlocks<OneBlockLink<LaneNormals<0>>> first;
  InBlocks<OneBlockLink<LaneNormals<1>>> second;
  ByteSource bytes;
  constexpr int bits = 5000;
  int same = 0;
  for (int i = 0; i < bits; ++i) {
    const std::uint32_t sent = bytes();
    lanes.key(sent);
    first.key(sent);
    second.key(sent >> 1);
    lanes.advance(787);
    first.advance(787);
    second.advance(787);
    same += lanes.lit() == (first.lit() | second.lit() << 1);
  }
  EXPECT_GE(same, bits - 2);
}

}  // namespace
}  // namespace bench
