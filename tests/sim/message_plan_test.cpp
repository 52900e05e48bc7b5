// A plan out of a recording of COSYS messages: what light there was while the module reported
// nothing.
#include "sim/fit/message_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/cosys.hpp"
#include "sim/failure.hpp"

namespace sim {
namespace {

constexpr double late_s = 0.2e-3;  // the output behind the light

/// Low for each run of zero bits; `bits` of the message, or all.
void add_message(PinRecording& recording, const std::string& text, double start_s, double bit_s,
                 std::size_t bits = 1000) {
  const std::vector<bool> line = protocol::line_bits(protocol::cosys_encode(text));
  for (std::size_t i = 0; i < std::min(bits, line.size()); ++i) {
    if (line[i]) continue;
    const double from_s = start_s + late_s + bit_s * static_cast<double>(i);
    if (i > 0 && !line[i - 1])
      recording.pulses.back().end_s = from_s + bit_s;
    else
      recording.pulses.push_back({from_s, from_s + bit_s});
  }
  recording.end_s = start_s + 1;
}

/// Light in the plan, one burst after the other.
struct LitFor {
  double start_s, cycles;
};
std::vector<LitFor> light_of(const Plan& plan) {
  std::vector<LitFor> all;
  for (const PlanStep& step : plan.steps)
    for (std::uint64_t i = 0; i < step.repeats; ++i)
      all.push_back(
          {step.start_ms * 1e-3 +
               static_cast<double>(i * (step.cycles_on + step.cycles_off)) / step.carrier_hz,
           static_cast<double>(step.cycles_on)});
  return all;
}

// The second message dies behind five characters; its light did not.
TEST(MessagePlan, HasTheLightOfBitsThatWereNotReported) {
  constexpr double bit_s = 1.02 / 600;  // the sender is 2 % slow
  const std::string text = "IND 011111 OK";
  PinRecording recording, all;
  for (int i = 0; i < 3; ++i) {
    add_message(recording, text, 0.1 + 0.8 * i, bit_s, i == 1 ? 50 : 1000);
    add_message(all, text, 0.1 + 0.8 * i, bit_s);
  }
  const MessagePlan found = plan_of_messages(recording, {}, "c.csv");
  EXPECT_EQ(found.message, text);
  EXPECT_EQ(found.messages, 3);
  EXPECT_EQ(found.whole, 2);
  const std::vector<LitFor> light = light_of(found.plan);
  ASSERT_EQ(light.size(), all.pulses.size());
  for (std::size_t i = 0; i < light.size(); ++i) {
    EXPECT_NEAR(light[i].start_s, all.pulses[i].start_s, 0.03e-3) << i;
    EXPECT_NEAR(light[i].cycles / 59e3, all.pulses[i].end_s - all.pulses[i].start_s, 0.03e-3) << i;
  }
}

TEST(MessagePlan, KnowsAMessageOfWhichNoneIsWholeIfItIsTold) {
  PinRecording recording;
  for (int i = 0; i < 4; ++i) add_message(recording, "IND 011111 OK", 0.1 + 0.8 * i, 1 / 600., 90);
  EXPECT_THROW(plan_of_messages(recording, {}, "c.csv"), Failure);
  const MessageLight light{.carrier_hz = 56e3, .message = "IND 011111 OK"};
  const MessagePlan found = plan_of_messages(recording, light, "c.csv");
  EXPECT_EQ(found.messages, 4);
  EXPECT_EQ(found.whole, 0);
  EXPECT_EQ(found.plan.steps.front().carrier_hz, 56e3);
  EXPECT_THROW(plan_of_messages(recording, {.message = "LUX 1"}, "c.csv"), Failure);
}

// Pulses before and between messages are of something else: no light is made of them.
TEST(MessagePlan, LeavesOutWhatIsOfNoMessage) {
  PinRecording recording;
  recording.pulses = {{0.01, 0.0102}, {0.0235, 0.0237}};
  add_message(recording, "A B", 0.1, 1 / 600.);
  const std::size_t of_it = recording.pulses.size() - 2;
  recording.pulses.push_back({0.5, 0.5004});
  add_message(recording, "A B", 0.8, 1 / 600.);
  EXPECT_EQ(light_of(plan_of_messages(recording, {}, "c.csv").plan).size(), 2 * of_it);
}

TEST(MessagePlan, RefusesWhatHasNoMessage) {
  PinRecording recording;
  for (int i = 0; i < 100; ++i) recording.pulses.push_back({0.013 * i, 0.013 * i + 0.005});
  recording.end_s = 2;
  EXPECT_THROW(plan_of_messages(recording, {}, "c.csv"), Failure);
  EXPECT_THROW(plan_of_messages({}, {}, "c.csv"), Failure);
}

}  // namespace
}  // namespace sim
