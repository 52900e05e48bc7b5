#pragma once
// Results of small links, for tests of `cosys-sim report`.
#include <string>

#include "program.hpp"

namespace sim {

class ReportCase : public CommandLine {
 protected:
  /// NAME.toml and NAME.h5.
  void run(const std::string& name, const std::string& sweep, const Words& options = {}) const {
    write_scenario(name + ".toml", sweep);
    Words words{"run", name + ".toml", "-q", "-o", name + ".h5"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome o = program(words);
    ASSERT_EQ(o.code, 0) << o.err;
  }
  /// The page of these results, and what else is wanted.
  std::string report(const Words& results) const {
    Words words{"report", "-o", "r.html"};
    words.insert(words.end(), results.begin(), results.end());
    const Outcome o = program(words);
    EXPECT_EQ(o.code, 0) << o.err;
    return content(path("r.html"));
  }
};

}  // namespace sim
