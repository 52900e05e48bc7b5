// With blocks of noise by Armadillo.
#include <algorithm>
#include <armadillo>

#include "reference_link.hpp"

namespace bench {
inline namespace COSYS_ISA {
namespace {

class ArmadilloNormals {
 public:
  ArmadilloNormals() { arma::arma_rng::set_seed(1); }
  void fill(float* normals) {
    normals_.randn();
    std::copy(normals_.begin(), normals_.end(), normals);
  }

 private:
  arma::fvec normals_ = arma::fvec(block);
};

}  // namespace

std::unique_ptr<ReferenceChain> make() {
  return std::make_unique<KeyedLinks<InBlocks<OneBlockLink<ArmadilloNormals>>>>();
}

}  // namespace COSYS_ISA
}  // namespace bench
