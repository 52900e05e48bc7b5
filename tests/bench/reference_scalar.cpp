// With the standard library's generator. Built twice: as the project is, and for speed alone.
#include "reference_link.hpp"

namespace bench {
inline namespace COSYS_ISA {
namespace {

class StandardNormals {
 public:
  float operator()() { return normal_(random_); }

 private:
  std::mt19937 random_{1};
  std::normal_distribution<float> normal_;
};

}  // namespace

std::unique_ptr<ReferenceChain> make() {
  return std::make_unique<KeyedLinks<OneLink<StandardNormals>>>();
}

}  // namespace COSYS_ISA
}  // namespace bench
