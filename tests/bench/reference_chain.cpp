#include "reference_chain.hpp"

namespace bench {

// Made by CMakeLists.txt: the namespace is the name of a variant.
namespace reference_scalar {
std::unique_ptr<ReferenceChain> make();
}
namespace reference_scalar_fast {
std::unique_ptr<ReferenceChain> make();
}
namespace reference_eigen {
std::unique_ptr<ReferenceChain> make();
}
namespace reference_armadillo {
std::unique_ptr<ReferenceChain> make();
}
namespace reference_lanes {
std::unique_ptr<ReferenceChain> make();
}

std::span<const ReferenceVariant> reference_variants() {
  static constexpr ReferenceVariant variants[] = {
      {"scalar", reference_scalar::make}, {"scalar_fast", reference_scalar_fast::make},
      {"eigen", reference_eigen::make},   {"armadillo", reference_armadillo::make},
      {"lanes", reference_lanes::make},
  };
  return variants;
}

}  // namespace bench
