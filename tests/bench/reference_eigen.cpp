// With a block of noise as an expression of Eigen.
#include <Eigen/Core>

#include "reference_link.hpp"

namespace bench {
inline namespace COSYS_ISA {
namespace {

class EigenNormals {
 public:
  void fill(float* normals) {
    using Block = Eigen::Array<float, block, 1>;
    Eigen::Map<Block> all(normals);
    all = Block::NullaryExpr([this] { return normal_(random_); });
  }

 private:
  std::mt19937 random_{1};
  std::normal_distribution<float> normal_;
};

}  // namespace

std::unique_ptr<ReferenceChain> make() {
  return std::make_unique<KeyedLinks<InBlocks<OneBlockLink<EigenNormals>>>>();
}

}  // namespace COSYS_ISA
}  // namespace bench
