// main() of the test programs: GoogleTest's, and a word about what was skipped. A skipped case is
// written to the file COSYS_SKIPPED, of which tests/run tells; where COSYS_NO_SKIPS is 1, as in the
// gate, it is a failure that says what to install.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

class Skips : public testing::EmptyTestEventListener {
 public:
  bool are_failures() const { return fails_ && n_ > 0; }

  void OnTestEnd(const testing::TestInfo& test) override {
    const testing::TestResult& result = *test.result();
    if (!result.Skipped()) return;
    ++n_;
    const std::string name = std::string(test.test_suite_name()) + "." + test.name();
    const std::string why = reason(result);
    if (!log_.empty()) std::ofstream(log_, std::ios::app) << name << ": " << why << '\n';
    if (fails_)
      std::printf("[  FAILED  ] %s: skipped (%s), which the gate does not take\n", name.c_str(),
                  why.c_str());
  }

 private:
  static std::string reason(const testing::TestResult& result) {
    for (int i = 0; i < result.total_part_count(); ++i)
      if (result.GetTestPartResult(i).skipped()) return result.GetTestPartResult(i).message();
    return "no reason given";
  }

  std::string log_ = variable("COSYS_SKIPPED");
  bool fails_ = variable("COSYS_NO_SKIPS") == "1";
  int n_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  auto* skips = new Skips;  // GoogleTest's own from here on, which outlives the run
  testing::UnitTest::GetInstance()->listeners().Append(skips);
  const int failed = RUN_ALL_TESTS();
  return skips->are_failures() ? 1 : failed;
}
