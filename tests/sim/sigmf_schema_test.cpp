// SigMF traces judged by python3-jsonschema: against the standard's requirements in
// sigmf_schema.json, and against the official schema where COSYS_SIGMF_SCHEMA names a copy of it
// (sigmf/SigMF, sigmf-schema.json).
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

using Json = nlohmann::json;

class SigmfSchema : public CommandLine {
 protected:
  void SetUp() override {
    if (start_tool(python, {"-c", "import jsonschema"}).finish().code != 0)
      GTEST_SKIP() << "needs python3-jsonschema";
    write_scenario("s.toml", "receiver.range_m = [0.5]");
    ASSERT_EQ(program({"trace", "s.toml", "-o", "t.sigmf-meta"}).code, 0);
  }

  /// What is wrong with a recording; empty of a good one.
  std::string problems(const std::string& meta) const {
    Words words{COSYS_SOURCE_DIR "/tests/sim/validate_sigmf.py", meta,
                COSYS_SOURCE_DIR "/tests/sim/sigmf_schema.json"};
    const char* official = std::getenv("COSYS_SIGMF_SCHEMA");
    if (official != nullptr) words.emplace_back(official);
    const Outcome o = start_tool(python, words).finish();
    EXPECT_EQ(o.err, "");
    EXPECT_EQ(o.code, o.out == "\n" ? 0 : 1);
    return o.out == "\n" ? "" : o.out;
  }

  /// The same of t.sigmf-meta with a value in it changed.
  std::string problems_with(const char* pointer, const Json& value) const {
    Json meta = Json::parse(content(path("t.sigmf-meta")));
    meta[Json::json_pointer(pointer)] = value;
    std::filesystem::copy_file(path("t.sigmf-data"), path("u.sigmf-data"),
                               std::filesystem::copy_options::overwrite_existing);
    write("u.sigmf-meta", meta.dump());
    return problems("u.sigmf-meta");
  }

  static constexpr const char* python = "/usr/bin/python3";
};

TEST_F(SigmfSchema, AcceptsBothRecordings) {
  EXPECT_EQ(problems("t.sigmf-meta"), "");
  EXPECT_EQ(problems("t-baseband.sigmf-meta"), "");
}

TEST_F(SigmfSchema, SeesWhatIsWrong) {
  EXPECT_EQ(problems_with("/global/core:description", "x"), "");
  EXPECT_NE(problems_with("/global/core:datatype", "rf16_le"), "");
  EXPECT_NE(problems_with("/global/core:version", "1"), "");
  EXPECT_NE(problems_with("/annotations/0/core:sample_start", 1'000'000'000), "");
  EXPECT_NE(problems_with("/annotations/0/core:sample_start", 50'000), "");
  EXPECT_NE(problems_with("/annotations/0/core:freq_lower_edge", 60e3), "");
  EXPECT_NE(problems_with("/captures/0", Json::object()), "");
  EXPECT_NE(problems_with("/global/core:sha512", std::string(128, '0')), "");
  EXPECT_NE(problems_with("/global/core:extensions/0", Json{{"name", "cosys"}}), "");
}

}  // namespace
