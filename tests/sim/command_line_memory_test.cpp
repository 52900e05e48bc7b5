// Memory does not grow with what is counted.
#include "program.hpp"

namespace {

constexpr long most_kb = 200 * 1024;

class Memory : public CommandLine {
 protected:
  /// Of a run on two threads.
  long peak_kb(const Words& set, const std::string& frames) const {
    Words words{"run", "s.toml", "-q", "-t", "2", "-e", "0", "-n", frames};
    for (const std::string& one : set) words.insert(words.end(), {"--set", one});
    const Outcome o = program(words);
    EXPECT_EQ(o.code, 0) << o.err;
    return o.peak_kb;
  }
  Memory() { write("s.toml", "[receiver]\nebn0_db = 14\n[simulation]\nwarmup_messages = 1\n"); }
};

TEST_F(Memory, MeasuredIsFlatInTheFramesOfDecisions) {
  const Words decisions{"receiver.module=ideal-coherent", "simulation.fidelity=decision"};
  const long few = peak_kb(decisions, "1e5"), many = peak_kb(decisions, "1e7");
  EXPECT_LT(many, few + 8 * 1024);
  EXPECT_LT(many, most_kb);
}

TEST_F(Memory, MeasuredIsFlatInTheFramesOfWaveforms) {
  const Words waveforms{"simulation.sample_rate_hz=250000"};
  const long few = peak_kb(waveforms, "512"), many = peak_kb(waveforms, "4096");
  EXPECT_LT(many, few + 8 * 1024);
  EXPECT_LT(many, most_kb);
}

TEST_F(Memory, MeasuredHoldsTheNoiseThatIsDrawn) {
  for (const char* receiver : {"TSSP4056", "ideal-noncoherent"})
    EXPECT_LT(peak_kb({std::string("receiver.module=") + receiver, "simulation.method=importance",
                       receiver[0] == 'T' ? "receiver.ebn0_db=36" : "receiver.ebn0_db=15"},
                      "64"),
              most_kb)
        << receiver;
}

}  // namespace
