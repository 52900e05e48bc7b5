// The lines of a capture: which of them is the module's output and which drives the LED, and the
// output as spells in which it reports light.
#include "sim/fit/captured_lines.hpp"

#include <gtest/gtest.h>

#include "capture_lines.hpp"

namespace sim {
namespace {

CapturedLine captured(const std::string& name, bool idle, double carrier_hz = 0) {
  return {
      .name = name, .initial = idle, .edges_s = {0.1, 0.2}, .end_s = 1, .carrier_hz = carrier_hz};
}

std::string module_of(const std::vector<CapturedLine>& lines, const WantedLines& wanted = {}) {
  return module_line(lines, wanted, "c.csv").name;
}

TEST(CapturedLines, TheModulesOutputIsTheOneThatCanBe) {
  const CapturedLine mark = captured("D7", false), output = captured("D8", true);
  EXPECT_EQ(module_of({captured("x", false)}), "x") << "the only one, however it idles";
  EXPECT_EQ(module_of({mark, output}), "D8");
  EXPECT_EQ(module_of({captured("D10", true, 56e3), mark, output}), "D8") << "no carrier is on it";
  EXPECT_EQ(module_of({captured("a", true), output}, {.drive = "a"}), "D8");
  EXPECT_EQ(module_of({captured("a", true), output, captured("ir.RX", false)}), "ir.RX");
  EXPECT_EQ(module_of({mark, output}, {.module = "D7"}), "D7") << "as it was named";
}

TEST(CapturedLines, TheModulesOutputIsNotGuessed) {
  EXPECT_EQ(test::failure_of([] {
              module_of({captured("a", true), captured("b", true)});
            }),
            "which wire of c.csv is the module's output (it may be a, b) say --wire");
  EXPECT_EQ(test::failure_of([] {
              module_of({captured("a", false), captured("b", false)});
            }),
            "which wire of c.csv is the module's output (none idles high: a, b) say --wire");
}

TEST(CapturedLines, TheLedIsDrivenByTheOtherWireOfTwo) {
  const CapturedLine mark = captured("D7", false), output = captured("D8", true);
  EXPECT_EQ(drive_line({mark, output}, {}, output, "c.csv"), "D7");
  EXPECT_EQ(drive_line({mark, output}, {.drive = "D9"}, output, "c.csv"), "D9");
  EXPECT_EQ(test::failure_of([&] {
              drive_line({mark, output, captured("D9", false)}, {}, output, "c.csv");
            }),
            "no plan of c.csv (no plan.txt is beside it, and several wires may drive the LED: "
            "D7, D9) say --plan PLAN, or --drive");
}

std::vector<std::pair<double, double>> spells(const CapturedLine& line,
                                              std::optional<bool> inverted = std::nullopt) {
  std::vector<std::pair<double, double>> all;
  for (const PinPulse& pulse : pin_recording(line, inverted, "c.csv").pulses)
    all.emplace_back(pulse.start_s, pulse.end_s);
  return all;
}

TEST(CapturedLines, TheOutputReportsWhereItDoesNotIdle) {
  using Spells = std::vector<std::pair<double, double>>;
  EXPECT_EQ(spells(captured("rx", true)), (Spells{{0.1, 0.2}}));
  EXPECT_EQ(spells(captured("rx", false)), (Spells{{0.1, 0.2}})) << "behind an inverter";
  EXPECT_EQ(spells(captured("rx", true), true), (Spells{{0, 0.1}, {0.2, 1}})) << "as it was told";
  CapturedLine cut = captured("rx", false);
  cut.edges_s = {0.1, 0.9};
  EXPECT_EQ(spells(cut), (Spells{{0, 0.1}, {0.9, 1}})) << "it reports at both ends";
  EXPECT_EQ(pin_recording(cut, {}, "c.csv").end_s, 1);
}

TEST(CapturedLines, RefusesWhatIsNoOutput) {
  EXPECT_EQ(test::failure_of([] { spells(captured("a", true, 56e3)); }),
            "a of c.csv (it has a carrier of 56 kHz, which a module's output has not) say --wire, "
            "the module's output");
  CapturedLine coarse = captured("a", true);
  coarse.resolution_s = 1e-3;
  EXPECT_EQ(test::failure_of([&] { spells(coarse); }),
            "a of c.csv (a sample each 1 ms is too few for a module's pulses) record at 100 kS/s "
            "or more");
  CapturedLine still = captured("a", true);
  still.edges_s = {};
  EXPECT_EQ(test::failure_of([&] { spells(still); }),
            "a of c.csv (it never changes: the module reported nothing, or is not connected) look "
            "at wires and supply, or say --wire");
}

}  // namespace
}  // namespace sim
