// The corpus of captures in tests/captures: what decode says of each, word by word.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

using Json = nlohmann::json;

std::vector<Json> json_lines(const std::string& text) {
  std::vector<Json> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(Json::parse(line));
  return lines;
}

/// Reals with five decimals (ppm, us): the last digits may be others on another machine.
Json rounded(Json json) {
  if (json.is_number_float()) return fmt::format("{:.5f}", json.get<double>());
  if (json.is_structured())
    for (Json& part : json) part = rounded(part);
  return json;
}

TEST_F(CommandLine, DecodeSaysOfEachCaptureOfTheCorpusWhatIsExpected) {
  const std::filesystem::path corpus = COSYS_SOURCE_DIR "/tests/captures";
  std::filesystem::create_directory_symlink(corpus, path("captures"));
  const Outcome o = program({"decode", "--json", "captures"});
  EXPECT_EQ(o.code, 0) << o.err;
  const std::vector<Json> said = json_lines(o.out),
                          expected = json_lines(content(corpus / "expected.jsonl"));
  ASSERT_EQ(said.size(), expected.size());
  for (std::size_t i = 0; i < said.size(); ++i) EXPECT_EQ(rounded(said[i]), rounded(expected[i]));
}

}  // namespace
