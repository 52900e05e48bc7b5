#pragma once
// Which program wrote a file: its name, its version and the commit that it was built from.
#include <string>

namespace sim {

struct ProgramInfo {
  std::string name;
  std::string version;
  std::string commit;
};

}  // namespace sim
