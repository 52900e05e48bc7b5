// What reaches a terminal, or a program behind a pipe, of texts that users named.
#include "sim/text/standard_output.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace sim {
namespace {

constexpr const char* obeyed = "a\x1b[31m\x7f\xc2\x9b\xc3\xa9\n\tb";  // and an e with an accent

TEST(StandardOutput, TextHasNoneOfWhatATerminalObeys) {
  testing::internal::CaptureStdout();
  print(obeyed);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "a?[31m??\xc3\xa9\n\tb");
}

TEST(StandardOutput, JsonHasNoneAndLosesNothing) {
  testing::internal::CaptureStdout();
  print_json(nlohmann::json{{"name", obeyed}}.dump());
  const std::string text = testing::internal::GetCapturedStdout();
  EXPECT_EQ(text.find('\x7f'), std::string::npos) << text;
  EXPECT_EQ(text.find("\xc2\x9b"), std::string::npos) << text;
  EXPECT_EQ(nlohmann::json::parse(text)["name"], obeyed);
}

TEST(StandardOutput, BytesAreAsTheyAre) {
  testing::internal::CaptureStdout();
  print_bytes(obeyed);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), obeyed);
}

}  // namespace
}  // namespace sim
