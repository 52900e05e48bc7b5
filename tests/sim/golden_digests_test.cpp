// What each shipped scenario counts does not change: the digests are frozen, and any number of
// threads, shards and processes ends in them. A change of a digest is a change of results: it is
// told in the CHANGELOG, and the digest here is that of `cosys-sim run` with the words below.
#include "program.hpp"

namespace {

struct Golden {
  const char* scenario;
  std::vector<std::string> set;  // so that it takes a second
  const char* digest;
};

const Golden shipped[] = {
    {"agc_constants",
     {"receiver.range_m=1,3", "module.agc_max_duty=0.2,0.4", "module.ambient_k=0,0.1",
      "module.agc_attack_db_per_ms=0.3"},
     "2cfe1446ab76ace30ab35fefcc2325b1"},
    {"arena", {"arena.runs=2", "arena.duration_s=20"}, "16b0526210a71c845e3f53c55690245b"},
    {"choose_module", {"receiver.range_m=2"}, "65ca2cb2003c142593384af0898662f9"},
    {"crowd",
     {"arena.runs=2", "devices.crowd.count=5,40", "arena.duration_s=5"},
     "d5d73d1cb897d4df24bfc118f0378064"},
    {"decoders", {}, "55d1bcfa04a0a0fdb8969481079cb807"},
    {"deep_ber", {}, "4694f24e0d05af982e1558e7e9d7051b"},
    {"detuned_carrier", {"receiver.range_m=1,2.2"}, "8a28fe66e7b814831067a29b074ac4f1"},
    {"false_accepts",
     {"listening.duration_s=5", "listening.runs=2"},
     "67a3ef714579525fee365318c024c3da"},
    {"floor", {"receiver.range_m=1.9,2.1"}, "297965d34c41d5c481edf5fd8020d4c9"},
    {"fluorescent",
     {"disturbance.lamp.irradiance_w_per_m2=0.001,0.01"},
     "eec3baf251c0a05bde437ee7658dd6e8"},
    {"guard", {"arena.runs=2", "arena.duration_s=20"}, "54da837e0e276f7369de9fff9726c78f"},
    {"location",
     {"location.trials=4", "location.device_x_m=0.9"},
     "0d9b137bc3c10b913324d15a0c528ef8"},
    {"population", {}, "453369fe996e6b687301c6a7ce6ef9c7"},
    {"presence", {"presence.trials=20"}, "dc0bbd101ad7c04153cfffb4fbac387e"},
    {"quickstart", {}, "4f368d919f0a05a111bea622cf2b655a"},
    {"remote_control", {}, "8f71e5b5461c18d883224cff980e293e"},
    {"sharedlink_over_light",
     {"exchange.duration_s=5", "exchange.runs=2", "receiver.range_m=1,12.5"},
     "6a59f2e278ae314207cd38f1ab7398aa"},
    {"sunlight", {"receiver.range_m=0.6,2"}, "3c8be2e130f36675380fab798f660a94"},
    {"theory", {}, "b15000136085df2572fd9343dfae7718"},
    {"theory_decision", {}, "159eed0d8eb4c29a7bb0792fcd84b2ae"},
};

/// Their sums of weights are rounded otherwise by processors of another kind.
bool is_frozen(const Golden& golden) { return golden.scenario != std::string("deep_ber"); }

class GoldenDigests : public CommandLine {
 protected:
  static Words words_of(const Golden& golden, const std::string& output) {
    const std::string file =
        std::string(COSYS_SOURCE_DIR) + "/scenarios/" + golden.scenario + ".toml";
    Words words{"run", file, "-q", "-o", output};
    if (content(file).find("\nexperiment = ") == std::string::npos)
      words.insert(words.end(), {"-n", "16", "-e", "0"});
    for (const std::string& set : golden.set) words.insert(words.end(), {"--set", set});
    return words;
  }

  Outcome run(const Golden& golden, const std::string& output, const Words& more) const {
    Words words = words_of(golden, output);
    words.insert(words.end(), more.begin(), more.end());
    Outcome outcome = program(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome;
  }

  /// Of one that is not frozen, what one thread counts.
  std::string expected(const Golden& golden) const {
    return is_frozen(golden) ? golden.digest : digest_of(run(golden, "one.h5", {"-t", "1"}).out);
  }
};

TEST_F(GoldenDigests, AreThoseOfEveryShippedScenario) {
  std::set<std::string> known;
  for (const Golden& golden : shipped) known.insert(golden.scenario);
  for (const auto& file :
       std::filesystem::directory_iterator(std::string(COSYS_SOURCE_DIR) + "/scenarios")) {
    if (file.path().extension() != ".toml") continue;
    EXPECT_TRUE(known.contains(file.path().stem())) << file.path() << " has none";
  }
}

TEST_F(GoldenDigests, OfAnyNumberOfThreads) {
  std::size_t n = 0;
  for (const Golden& golden : shipped)
    EXPECT_EQ(digest_of(run(golden, "a.h5", {"-t", n++ % 2 == 0 ? "8" : "1"}).out),
              expected(golden))
        << golden.scenario;
}

TEST_F(GoldenDigests, MeasuredOfShards) {
  for (const Golden& golden : shipped) {
    run(golden, "1.h5", {"-t", "2", "--shard", "1/2"});
    run(golden, "2.h5", {"-t", "1", "--shard", "2/2"});
    EXPECT_EQ(digest_of(program({"merge", "2.h5", "1.h5", "-o", "sum.h5"}).out), expected(golden))
        << golden.scenario;
  }
}

#ifdef COSYS_MPIRUN
TEST_F(GoldenDigests, MeasuredOfProcesses) {
  ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  for (const Golden& golden : shipped) {
    Words job{"-n", "2", "--oversubscribe", COSYS_PROGRAM};
    for (const std::string& word : words_of(golden, "a.h5")) job.push_back(word);
    job.insert(job.end(), {"-t", "1"});
    const Outcome o = start_tool(COSYS_MPIRUN, job).finish();
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(digest_of(o.out), expected(golden)) << golden.scenario;
  }
}
#endif

}  // namespace
