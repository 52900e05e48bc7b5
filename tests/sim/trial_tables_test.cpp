// What stands below the pictures of a trial: of made up ones.
#include "sim/page/trial_tables.hpp"

#include <gtest/gtest.h>

#include "made_up_trial.hpp"

namespace sim {
namespace {

using Rows = std::vector<std::vector<std::string>>;

TEST(CharactersTable, SaysWhatWasReadInThePlaceOfEach) {
  const PageTable table = characters_table(made_up_trial("OK\n", "OJ"));
  EXPECT_EQ(table.rows, (Rows{{"1", "0.00", "O", "O", "0"},
                              {"2", "16.67", "K", "J", "1"},
                              {"3", "33.33", "\\n", "-", "7"}}))
      << "an idle pin is dark, as two bits of a line feed and its stop bit are";
}

TEST(CharactersTable, ComparesBitsWithThoseOfAPinThatIsLater) {
  TracedTrial trial = made_up_trial("OK\n", "");
  trial.rx = dsp::LogicTrace();
  send_at(trial.rx, "OK\n", 0.1 + 1 / made_up_baud.value);
  trial.delay = dsp::period(made_up_baud);
  for (const auto& row : characters_table(trial).rows) EXPECT_EQ(row.back(), "0");
}

TEST(EyeTable, HasTheLeastOfLightAndTheGreatestOfDark) {
  TracedTrial trial = made_up_trial("U", "U");  // light and dark in turn
  trial.sample_rate = dsp::Hertz(60'000);
  const double bit_s = 1 / made_up_baud.value;
  for (int i = 0; i < 30'000; ++i) {
    const dsp::Seconds at(i / trial.sample_rate.value - bit_s / 4);  // a quarter of a bit late
    trial.taps.integrator.push_back(trial.tx.level_at(at) ? 10.0F : 80.0F);
  }
  trial.taps.integrator[static_cast<std::size_t>((0.1 + 2.5 * bit_s) * 60'000)] = 70;
  const PageTable table = eye_table(trial);
  ASSERT_EQ(table.rows.size(), 9U);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"0", "10", "80", "closed"}));
  EXPECT_EQ(table.rows[4], (std::vector<std::string>{"0.5", "70", "10", "60"}));
  EXPECT_EQ(table.rows[8], (std::vector<std::string>{"1", "80", "10", "70"}));
}

}  // namespace
}  // namespace sim
