#include "sim/scenario/detector.hpp"

namespace sim {

const std::vector<std::string>& detector_names() {
  static const std::vector<std::string> names{"synchronous", "goertzel", "dc-difference"};
  return names;
}

}  // namespace sim
