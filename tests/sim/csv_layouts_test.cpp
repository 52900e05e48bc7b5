// Tables as instruments and programs write them (sim/capture/csv_head.hpp names each and where its
// layout is documented): one COSYS message in every layout, and what decode says that it read.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "protocol/cosys.hpp"

namespace {

constexpr double begin_s = 0.03, bit_s = 1 / 600.0;

/// The line of "IND 011111 OK" at a time, idle high.
bool level_at(double time) {
  static const protocol::Bytes bytes = protocol::cosys_encode("IND 011111 OK");
  const double slot = std::floor((time - begin_s) / bit_s + 1e-9);
  if (slot < 0) return true;
  const auto byte = static_cast<std::size_t>(slot / 10);
  if (byte >= bytes.size()) return true;
  return protocol::line_bit(bytes[byte], static_cast<int>(slot) % 10);
}

/// Rows every `step` for 0.36 s, each by `row` of its time and level.
std::string rows(double step, const std::function<std::string(double, bool)>& row) {
  std::string text;
  for (int i = 0; i * step < 0.36; ++i) text += row(i * step, level_at(i * step));
  return text;
}

/// Rows where the level changes alone; times in `unit`, without decimals.
std::string changes(double unit, const std::string& more = "") {
  std::string text = "0,1" + more + "\n";
  bool last = true;
  for (int slot = 0; slot < 190; ++slot) {
    const double time = begin_s + slot * bit_s;
    if (level_at(time) == last) continue;
    last = !last;
    text += fmt::format("{:.0f},{}{}\n", time / unit, last ? 1 : 0, more);
  }
  return text;
}

class CsvLayouts : public CommandLine {
 protected:
  nlohmann::json line_of(const std::string& text, const Words& options = {}, int code = 0) const {
    write("t.csv", text);
    Words words{"decode", "t.csv", "--json"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome o = program(words);
    EXPECT_EQ(o.code, code) << o.err << text.substr(0, 200);
    EXPECT_NE(o.out.find("\"IND 011111 OK\",\"outcome\":\"ok\""), std::string::npos)
        << o.out << text.substr(0, 200);
    const std::size_t last = o.out.rfind("{\"line\"");
    if (last == std::string::npos) return {};
    return nlohmann::json::parse(o.out.substr(last)).at("line");
  }

  void expect_read(const std::string& text, const std::string& channel,
                   const Words& options = {}) const {
    const auto line = line_of(text, options);
    if (line.empty()) return;
    EXPECT_EQ(line.at("baud"), 600) << text.substr(0, 200);
    EXPECT_EQ(line.at("polarity"), "idle-high") << text.substr(0, 200);
    EXPECT_EQ(line.at("capture").at("channel"), channel) << text.substr(0, 200);
  }
};

std::string volts(bool level) { return level ? "3.32" : "0.04"; }

TEST_F(CsvLayouts, HeadsBesideTheRows) {
  int i = 0;
  const char* head[] = {"Record Length,1.08e+03,",
                        "Sample Interval,3.333333e-04,",
                        "Trigger Point,1.5e+02,",
                        ",,",
                        "Source,CH1,",
                        "Vertical Units,V,",
                        "Vertical Scale,1.0e+00,",
                        "Vertical Offset,0.0e+00,",
                        "Horizontal Scale,2.5e-02,",
                        "Yzero,0.0e+00,"};
  expect_read(rows(1 / 3000.0,
                   [&](double t, bool level) {
                     const char* beside = i < 10 ? head[i++] : ",,";
                     return fmt::format("{},{:.9f},{},\n", beside, t - 0.05, volts(level));
                   }),
              "CH1");
}

TEST_F(CsvLayouts, NamesAndUnitsInEitherOrder) {
  const auto two = [](double t, bool level) {
    return fmt::format("{:.6E},{},{}\n", t - 0.05, 0.01 * std::sin(1e4 * t), volts(level));
  };
  expect_read("x-axis,1,2\nsecond,Volt,Volt\n" + rows(1 / 3000.0, two), "2");
  expect_read("second,Volt,Volt\nx-axis,1,2\n" + rows(1 / 3000.0, two), "2", {"--channel", "2"});
  expect_read("Time,A,B\n(s),(mV),(V)\n\n" + rows(1 / 3000.0, two), "B");
  expect_read("in s,CH1 in V,CH2 in V\n" + rows(1 / 3000.0, two), "CH2 in V", {"--channel", "CH2"});
  expect_read("seconds,CH1,CH2\n" + rows(1 / 3000.0, two), "CH2");
}

TEST_F(CsvLayouts, UnitsOfTimeInAllSpellings) {
  for (const char* heading : {"Time (usec)", "Time [us]", "time_us", "Time(\u00b5s)", "t/us",
                              "Time (microseconds)", "Time in us"})
    expect_read(std::string(heading) + ",rx\n" + changes(1e-6), "rx");
  expect_read("Time (ns),rx\n" + changes(1e-9), "rx");
  expect_read("Time,rx\n" + changes(1e-6), "rx", {"--time-unit", "us"});
  expect_read("Time,rx\n" + changes(1e-7), "rx", {"--time-unit", "100ns"});
  write("t.csv", "Time (fortnight),rx\n" + changes(1e-6));
  expect_refused({"decode", "t.csv"}, 2,
                 "the time's unit 'fortnight' in t.csv:1 (no such unit is known here) give rows of "
                 "numbers, a column for each wire");
}

/// As `sigrok-cli -O csv:time=true` writes it: `ticks` a sample, in a unit that the head may name.
std::string sigrok_changes(const std::string& rate_text, double rate, int ticks,
                           const std::string& unit) {
  std::string text =
      "; CSV generated by libsigrok 0.5.2\n; Channels (1/1): RX\n; Samplerate: " + rate_text +
      "\n" + unit + ",logic\n0,1\n";
  bool last = true;
  for (std::int64_t sample = 0; static_cast<double>(sample) < 0.36 * rate; ++sample)
    if (level_at(static_cast<double>(sample) / rate) != last) {
      last = !last;
      text += fmt::format("{},{}\n", sample * ticks, last ? 1 : 0);
    }
  return text;
}

TEST_F(CsvLayouts, SigroksTimesAreWholeTicksASample) {
  for (const char* unit : {"Time", "microseconds"}) {
    expect_read(sigrok_changes("100 kHz", 1e5, 10, unit), "RX");
    expect_read(sigrok_changes("600 kHz", 6e5, 1, unit), "RX");
    expect_read(sigrok_changes("96 kHz", 96e3, 10, unit), "RX");
  }
  expect_read(sigrok_changes("24 MHz", 24e6, 41, "nanoseconds"), "RX");
  expect_read(sigrok_changes("24 MHz", 24e6, 41, "Time"), "RX");
}

TEST_F(CsvLayouts, RowsThatBeginWithNothingAreRows) {
  const auto two = [n = 0](double, bool level) mutable {
    return fmt::format("{},{}\n", n++ < 40 ? "X" : "1", level ? 1 : 0);
  };
  const auto line = line_of("tx,rx\n" + rows(1 / 3000.0, two), {"--sample-rate", "3000"});
  EXPECT_EQ(line.at("capture").at("channel"), "rx");
  EXPECT_EQ(line.at("capture").at("channels").size(), 2U);
}

TEST_F(CsvLayouts, NamesBehindAMark) { expect_read("# time_us,rx\n" + changes(1e-6), "rx"); }

TEST_F(CsvLayouts, HeadingsThatLookLikeRatesAreNames) {
  expect_read("timestep,rx\n" + changes(1e-6), "rx", {"--time-unit", "us"});
  const auto one = [](double, bool level) { return level ? "83\n" : "-1\n"; };
  expect_read("Sample Rate,3000,Record Length,1080\nvalue\n" + rows(1 / 3000.0, one), "value");
  expect_read("Sample Rate,auto\nvalue\n" + rows(1 / 3000.0, one), "value",
              {"--sample-rate", "3kHz"});
}

TEST_F(CsvLayouts, NumbersOfChannelsAreThoseOfTheFile) {
  const auto two = [](double t, bool level) {
    return fmt::format("{:.7f},{},0.000\n", t, volts(level));
  };
  expect_read("Time(s),CH1(V),CH2(V)\n" + rows(1 / 3000.0, two), "CH1(V)", {"--channel", "1"});
}

TEST_F(CsvLayouts, AMovingColumnOfLevelsIsNoBetterThanALine) {
  const auto with_trigger = [](double t, bool level) {
    return fmt::format("{:.7f},{},{}\n", t, t > 0.1 && t < 0.2 ? 1 : 0, volts(level));
  };
  expect_read("Time(s),Trigger,CH1(V)\n" + rows(1 / 3000.0, with_trigger), "CH1(V)");
}

TEST_F(CsvLayouts, NumbersOfRowsAreNoChannel) {
  const auto counted = [n = 0](double t, bool level) mutable {
    return fmt::format("{:.7f},{},{}\n", t, n++, volts(level));
  };
  const auto line = line_of("Time(s),Index,CH1(V)\n" + rows(1 / 3000.0, counted));
  EXPECT_EQ(line.at("capture").at("channels").size(), 1U);
}

TEST_F(CsvLayouts, NamesThatAreNoUtf8AreShownAllTheSame) {
  const auto two = [](double t, bool level) { return fmt::format("{:.7f},{}\n", t, volts(level)); };
  write("t.csv", "Zeit (s),Spannung (\xb5V)\n" + rows(1 / 3000.0, two));
  const Outcome json = program({"decode", "t.csv", "--json"});
  EXPECT_EQ(json.code, 0) << json.err;
  EXPECT_NE(json.out.find("Spannung"), std::string::npos);
  EXPECT_NE(program({"decode", "t.csv"}).out.find("\\xb5V"), std::string::npos);
}

TEST_F(CsvLayouts, RatesAndIntervalsInTheHead) {
  const auto one = [](double, bool level) { return level ? "83,\n" : "-1,\n"; };
  expect_read("Memory Length,1080,\nSource,CH1,\nSampling Period,3.33333E-04,\nWaveform Data,\n" +
                  rows(1 / 3000.0, one),
              "Waveform Data");
  expect_read("# Sample rate: 3 kSa/s\nvalue\n" + rows(1 / 3000.0, one), "value");
  expect_read("Sample Interval,333.333,us\nvalue\n" + rows(1 / 3000.0, one), "value");
  write("t.csv", "Sample Interval,3.3,fortnight\nvalue\n" + rows(1 / 3000.0, one));
  expect_refused({"decode", "t.csv"}, 2,
                 "Sample Interval 'fortnight' in t.csv:1 (it is in no unit that is known here) say "
                 "--sample-rate");
}

TEST_F(CsvLayouts, DecimalCommas) {
  const auto row = [](const char* separator) {
    return [separator](double t, bool level) {
      std::string text = fmt::format("{:.6f}{}{}\n", 1e3 * t, separator, volts(level));
      std::ranges::replace(text, '.', ',');
      return text;
    };
  };
  expect_read("Time\tChannel A\n(ms)\t(V)\n\n" + rows(1 / 3000.0, row("\t")), "Channel A");
  expect_read("Time (ms);A (V)\n" + rows(1 / 3000.0, row(";")), "A (V)");
}

TEST_F(CsvLayouts, CellsThatSayNothing) {
  expect_read("Time [us],Channel 0,Channel 1\n" + changes(1e-6, ",X"), "Channel 0");
  for (const char* nothing : {"NaN", "inf", "-", "", "None", "NULL", "#N/A"})
    expect_read("Time [us],Channel 0,Channel 1\n" + changes(1e-6, std::string(",") + nothing),
                "Channel 0");
}

TEST_F(CsvLayouts, DeadColumnsAndColumnsOfNoiseAreNotPreferred) {
  const auto with = [](const std::string& before, const std::string& behind) {
    return rows(1 / 3000.0, [=](double t, bool level) {
      return fmt::format("{:.7f}{},{}{}\n", t, before, volts(level), behind);
    });
  };
  expect_read("Time(s),CH1(V),CH2(V)\n" + with("", ",0.000"), "CH1(V)");
  expect_read("Time(s),CH1(V),CH2(V)\n" + with(",0.000", ""), "CH2(V)");
  expect_read("Time(s),CLK,RX\n" + rows(1e-4,
                                        [](double t, bool level) {
                                          return fmt::format("{:.7f},0,{}\n", t, level ? 1 : 0);
                                        }),
              "RX");
}

TEST_F(CsvLayouts, ManyZerosBeforeTheFirstEdge) {
  std::string text = "Time(s),CH1(V)\n";
  for (int i = 0; i < 1500; ++i) text += fmt::format("{:.7f},0.00\n", i / 3000.0);
  text += rows(1 / 3000.0, [](double t, bool level) {
    return fmt::format("{:.7f},{}\n", 0.5 + t, level ? "0.00" : "3.30");
  });
  EXPECT_EQ(line_of(text).at("polarity"), "idle-low");
}

TEST_F(CsvLayouts, PairsOfRowsAtOneTime) {
  expect_read("Time,CH1 in V\n" + rows(1 / 3000.0,
                                       [](double t, bool level) {
                                         return fmt::format("{0:.5E},{1}\n{0:.5E},{1}\n", t,
                                                            volts(level));
                                       }),
              "CH1 in V");
}

TEST_F(CsvLayouts, DatesAsSecondsAndNoOthers) {
  std::string text = "timestamp,rx\n";
  bool last = false;
  for (int sample = 0; sample < 36000; ++sample)
    if (level_at(sample * 1e-5) != last) {
      last = !last;
      text += fmt::format("{:.5f},{}\n", 1.7e9 + sample * 1e-5, last ? 1 : 0);
    }
  expect_read(text, "rx");
  write("t.csv", "time,rx\n2026-05-01T12:00:00.25,1\n2026-05-01T12:00:00.26,0\n");
  expect_refused({"decode", "t.csv"}, 2,
                 "the time '2026-05-01T12:00:00.25' in t.csv:2 (it is a time of day, and no number "
                 "of seconds) give rows of numbers, a column for each wire");
}

TEST_F(CsvLayouts, FewSamplesABit) {
  expect_read("; Samplerate: 2 kHz\nrx\n" +
                  rows(1 / 2000.0, [](double, bool level) { return level ? "1\n" : "0\n"; }),
              "rx");
}

TEST_F(CsvLayouts, IdleIsWhatLiesBetweenCharacters) {
  std::string text = "Time [s],rx\n0,0\n2,1\n";  // no supply at first
  bool last = true;
  for (int slot = 0; slot < 190; ++slot) {
    const double time = begin_s + slot * bit_s;
    if (level_at(time) != last) {
      last = !last;
      text += fmt::format("{:.6f},{}\n", 2 + time, last ? 1 : 0);
    }
  }
  expect_read(text, "rx");
  EXPECT_EQ(line_of(text).at("capture").at("polarity_by"), "by the characters");
}

TEST_F(CsvLayouts, RowsAreSkippedWhenTold) {
  expect_read("1,2\n3,4\nTime (us),rx\n" + changes(1e-6), "rx", {"--skip-rows", "2"});
}

TEST_F(CsvLayouts, TwoLinesThatReadAsWellAreSaid) {
  std::string text = "Time [us],Channel 0,Channel 1\n";
  std::istringstream lines(changes(1e-6));
  std::string before = "1";  // the other follows a row later
  for (std::string line; std::getline(lines, line);) {
    const std::string level = line.substr(line.find(',') + 1);
    const auto time = std::stol(line);
    text += fmt::format("{},{}\n{},{},{}\n", line, before, time + 20, level, level);
    before = level;
  }
  text += "400000,1,1\n";
  EXPECT_EQ(line_of(text, {}, 4).at("capture").at("channel"), "Channel 0");
  EXPECT_EQ(line_of(text, {"--channel", "2"}).at("capture").at("channel"), "Channel 1");
}

/// A column of volts, without a time.
std::string samples_alone(const std::string& before = "", const std::string& behind = "") {
  return rows(1 / 3000.0,
              [&](double, bool level) { return before + volts(level) + behind + "\n"; });
}

/// Times in units of `unit`, and volts.
std::string samples_at(double unit, const std::string& before = "",
                       const std::string& behind = "") {
  return rows(1 / 3000.0, [&](double t, bool level) {
    return fmt::format("{}{:.6f},{}{}\n", before, t / unit, volts(level), behind);
  });
}

TEST_F(CsvLayouts, RatesBesideTheirUnitsAndKeys) {
  for (const char* head :
       {"Sample Rate (kHz),3", "# Sampling frequency [kHz]: 3", "Sample Rate:,3000.0,",
        "XInc:,3.333333E-04", "Time interval :,333.3333uS", "Sampling interval:,333.3333us",
        "Sample Rate,3 kS/sec", "; Sample rate: 3 kHz\n; Maximum sample rate: 960 kHz"})
    expect_read(std::string(head) + "\nvalue\n" + samples_alone(), "value");
  expect_read("Sample Rate,3000,3000\nA,B\n" + samples_alone("0.0,"), "B");
  expect_read("CH1(V),t0 = -5e-03s, tInc = 3.333333e-04s,\n" + samples_alone("", ","), "CH1(V)");
  expect_read(
      "Sample interval;3,333333E-04;s\nA;CH1\n" +
          rows(1 / 3000.0, [](double, bool level) { return level ? "0,0;3,32\n" : "0,0;0,04\n"; }),
      "CH1");
}

TEST_F(CsvLayouts, RatesThatContradictAreRefusedUnlessRowsHaveTimes) {
  const std::string two = "Sample Rate,3000\nSample Rate,96000\n";
  write("t.csv", two + "value\n" + samples_alone());
  expect_refused({"decode", "t.csv"}, 2,
                 "Sample Rate '96000' in t.csv:2 (the head has said another rate before) say "
                 "--sample-rate");
  expect_read("Sample Rate: 1 GSa/s\nTime (s),CH1 (V)\n" + samples_at(1), "CH1 (V)");
  expect_read("Sample Rate: 3 furlongs\nTime (s),CH1 (V)\n" + samples_at(1), "CH1 (V)");
}

TEST_F(CsvLayouts, SeparatorsInQuotesPartNothing) {
  expect_read("\"Time (ms)\",\"RX, filtered\"\n" + samples_at(1e-3), "RX, filtered");
  expect_read("\"Time (ms)\",\"RX\"\n" + rows(1 / 3000.0,
                                              [&](double t, bool level) {
                                                std::string text = fmt::format(
                                                    "\"{:.6f}\";\"{}\"\n", 1e3 * t, volts(level));
                                                std::ranges::replace(text, '.', ',');
                                                std::ranges::replace(text, ';', ',');
                                                return text;
                                              }),
              "RX");
}

// "10,1" is no number where no line has a tab or a semicolon.
TEST_F(CsvLayouts, AnEmptyCellDoesNotMakeDecimalCommas) {
  expect_read("time_us,rx\n0,1\n50,\n" + changes(1e-6).substr(4), "rx");
}

TEST_F(CsvLayouts, RowsOfSemicolonsMayBeginWithOne) {
  const auto two = [n = 0](double, bool level) mutable {
    return fmt::format("{};{}\n", n++ % 400 < 40 ? "" : "1", level ? 1 : 0);
  };
  expect_read("tx;rx\n" + rows(1 / 3000.0, two), "rx", {"--sample-rate", "3000"});
}

TEST_F(CsvLayouts, SigroksTriggerIsNotItsChannel) {
  const std::string head =
      "; CSV generated by libsigrok 0.5.2\n; Channels (2/2): CLK, RX\n; Samplerate: 3 kHz\n";
  const auto row = [](double, bool level) { return level ? "0,1,0\n" : "0,0,0\n"; };
  for (const char* names : {"CLK,RX,Trigger\n", "logic,logic,Trigger\n", ""})
    expect_read(head + names + rows(1 / 3000.0, row), "RX");
  const auto timed = [n = 0](double, bool level) mutable {
    return fmt::format("{},0,{}\n", 333 * n++, level ? 1 : 0);
  };
  expect_read(head + rows(1 / 3000.0, timed), "RX");
}

TEST_F(CsvLayouts, ColumnsOfOtherTimesAreRefused) {
  write("t.csv", "Time A (s),A,Time RX (s),RX\n" + rows(1 / 3000.0, [](double t, bool level) {
                   return fmt::format("{:.6f},0,{:.6f},{}\n", t, t / 2, volts(level));
                 }));
  expect_refused({"decode", "t.csv"}, 2,
                 "'Time A (s)' and 'Time RX (s)' in t.csv:1 (each tells another time) keep the "
                 "columns of one of them");
  expect_read("Time (s),Time (us),rx\n" + rows(1 / 3000.0,
                                               [](double t, bool level) {
                                                 return fmt::format("{:.2f},{:.0f},{}\n", t,
                                                                    1e6 * t, level ? 1 : 0);
                                               }),
              "rx");
  const std::string lists =
      "Time A (us),A,Time RX (us),RX\n0,1,0,1\n100,0,20000,0\n200,1,21666,1\n"
      "90000,0,23333,0\n90100,1,25000,1\n";
  write("t.csv", lists);
  EXPECT_EQ(program({"decode", "t.csv"}).code, 2) << "lists of changes";
  expect_read("timestamp,time_ms,rx\n" + rows(1 / 3000.0,
                                              [](double t, bool level) {
                                                return fmt::format("{:.0f},{:.6f},{}\n",
                                                                   1e6 + std::floor(t), 1e3 * t,
                                                                   volts(level));
                                              }),
              "rx");
}

TEST_F(CsvLayouts, UnitsInNamesAndOtherLanguages) {
  for (const char* heading : {"millis", "timeMs", "time..ms.", "Time - ms", "Zeit [ms]",
                              "Runtime [ms]", "\u65f6\u95f4\uff08ms\uff09", "Temps en ms (ms)"})
    expect_read(std::string(heading) + ",rx\n" + samples_at(1e-3), "rx");
  expect_read("\u65f6\u95f4,rx\n\u6beb\u79d2,\u4f0f\n" + samples_at(1e-3), "rx");
  expect_read("Zeit,rx\nMillisekunden,Volt\n" + samples_at(1e-3), "rx");
  expect_read("Time (\xb5s),rx\n" + changes(1e-6), "rx");
  expect_read("Time,A,D0\n(ms),(V),\n\n" + samples_at(1e-3, "", ",0"), "A");
}

TEST_F(CsvLayouts, AUnitOfTimeIsNeverLost) {
  for (const char* head :
       {"# Time unit: ms\nTime,rx\n", "Horizontal Units,ms\nTIME,rx\n", "X Units,ms\nX,rx\n"}) {
    write("t.csv", head + samples_at(1e-3));
    const Outcome o = program({"decode", "t.csv"});
    EXPECT_EQ(o.code, 2) << head << o.out;
    if (o.code != 2) continue;
    EXPECT_NE(o.err.find("'ms' in t.csv:1 (the unit belongs to no column of these rows) say "
                         "--time-unit ms, or s\n"),
              std::string::npos)
        << o.err;
  }
  expect_read("# Time [ms] RX [V]\n" + rows(1 / 3000.0,
                                            [](double t, bool level) {
                                              return fmt::format("{:.6f} {}\n", 1e3 * t,
                                                                 volts(level));
                                            }),
              "RX [V]");
  expect_read("Time RX\n(ms) (V)\n" + rows(1 / 3000.0,
                                           [](double t, bool level) {
                                             return fmt::format("{:.6f} {}\n", 1e3 * t,
                                                                volts(level));
                                           }),
              "RX");
  write("t.csv", rows(1 / 3000.0, [n = 0](double t, bool level) mutable {
          return fmt::format("{},{:.6f},{}\n", n++ == 0 ? "X Units,ms," : ",,", 1e3 * t,
                             volts(level));
        }));
  EXPECT_EQ(program({"decode", "t.csv"}).code, 2) << "beside the rows";
  expect_read("Time (ms),RX,Comment\n" + samples_at(1e-3), "RX");
  expect_read("Time (s),RX\nDate,2026/11/25\n" + samples_at(1), "RX");
  expect_read("# Time (ms),RX\n# made by a logger, 2026\n" + samples_at(1e-3), "RX");
}

// 600 Bd would be a standard rate.
TEST_F(CsvLayouts, AnAssumedUnitThatMakesAnOddRateIsDoubted) {
  const auto line = line_of("time,rx\n" + samples_at(1e-3), {}, 4);
  EXPECT_NEAR(line.at("baud"), 0.6, 1e-3);
  EXPECT_EQ(program({"decode", "t.csv"}).err,
            "cosys-sim: its times may be in ms (the rate would be 600 Bd) say --time-unit\n");
}

TEST_F(CsvLayouts, NumbersOfRowsAreNoTime) {
  const auto counted = [](const char* separator) {
    return rows(1 / 3000.0, [=, n = 0](double t, bool level) mutable {
      return fmt::format("{}{}{:.6f}{}{}\n", ++n, separator, 1e3 * t, separator, volts(level));
    });
  };
  expect_read("Nr.;Zeit [ms];RX [V]\n" + counted(";"), "RX [V]");
  expect_read(";Zeit [ms];RX\n" + counted(";"), "RX");
  const auto numbered = [n = 0](double, bool level) mutable {
    return fmt::format("{},{}\n", ++n, level ? 1 : 0);
  };
  expect_read("Sample Rate,3000\nSample No.,RX\n" + rows(1 / 3000.0, numbered), "RX");
  expect_read("id,RX\n" + rows(1 / 3000.0, numbered), "RX", {"--sample-rate", "3kHz"});
  const auto risen = [n = 0](double, bool level) mutable {
    return fmt::format("{},{}\n", n += 7, level ? 1 : 0);
  };
  const auto line = line_of("Sample Rate,3000\naddress,RX\n" + rows(1 / 3000.0, risen));
  EXPECT_EQ(line.at("baud"), 600);
  expect_read("address,RX\n" + rows(1 / 3000.0, risen), "RX", {"--sample-rate", "3kHz"});
  write("t.csv", "id,RX\n" + rows(1 / 3000.0, numbered));
  EXPECT_EQ(program({"decode", "t.csv"}).code, 2);
}

TEST_F(CsvLayouts, WordsInRowsAreNoNames) {
  write("t.csv", "Time (ms),RX\n0.1,****\n" + samples_at(1e-3));
  expect_refused(
      {"decode", "t.csv"}, 2,
      "'****' in t.csv:2 (it is no number) give rows of numbers, a column for each wire");
  write("t.csv", "Time (ms),RX\n0.1,****\n\n# on\n" + samples_at(1e-3));
  EXPECT_EQ(program({"decode", "t.csv"}).code, 2);
  write("t.csv", "Time (ms),RX\n0.1,High\n0.2,Low\n");
  expect_refused(
      {"decode", "t.csv"}, 2,
      "'High' in t.csv:2 (it is no number) give rows of numbers, a column for each wire");
}

TEST_F(CsvLayouts, DatesOfAnotherUnitAreRefused) {
  write("t.csv", "timestamp,rx\n1764072000000,1\n1764072000001,0\n1764072000003,1\n");
  expect_refused({"decode", "t.csv"}, 2,
                 "a time of 1.764072e+12 s in t.csv:2 (it is after the year 2099) say --time-unit "
                 "ms, or what their unit is");
}

TEST_F(CsvLayouts, MissingRowsAreSaid) {
  std::string text = "Time (s),CH1\n" + samples_at(1);
  const std::size_t from = text.find("\n0.120"), to = text.find("\n0.125");
  text.erase(from, to - from);
  write("t.csv", text);
  const Outcome o = program({"decode", "t.csv"});
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("rows of an analogue column are missing before it"), std::string::npos)
      << o.err;
}

TEST_F(CsvLayouts, SignalsBeyondTheRangeAreRefused) {
  for (const char* beyond : {"\u221e", "inf", "9.9E+37"}) {
    write("t.csv", "Time (s),CH1\n" + rows(1 / 3000.0, [&](double t, bool level) {
                     return fmt::format("{:.6f},{}\n", t, level ? beyond : "0.01");
                   }));
    expect_refused(
        {"decode", "t.csv"}, 2,
        "column CH1 in t.csv:2 (its signal is often beyond what the instrument could show) "
        "record it again in a wider range");
  }
}

// Rare cells beyond the range are a little beyond the others.
TEST_F(CsvLayouts, FewCellsBeyondTheRangeAreRead) {
  const auto peaks = [n = 0](double t, bool level) mutable {
    return fmt::format("{:.6f},{}\n", t, !level ? "0.01" : ++n % 40 == 0 ? "inf" : "3.3");
  };
  expect_read("Time (s),CH1\n" + rows(1 / 3000.0, peaks), "CH1");
  write("t.csv", "Time (s),CH1\n" + rows(1 / 3000.0, [](double t, bool) {
                   return fmt::format("{:.6f},{}\n", t, t > 0.1 && t < 0.11 ? "inf" : "0.01");
                 }));
  EXPECT_NE(program({"decode", "t.csv"}).code, 0) << "a pulse is no character";
  const auto two = [](double t, bool level) {
    return fmt::format("{:.6f},0.00,{}\n", t, level ? "inf" : "0.01");
  };
  write("t.csv", "Time (s),CH1,CH2\n" + rows(1 / 3000.0, two));
  EXPECT_NE(
      program({"decode", "t.csv"}).out.find("no line on CH2, which is often beyond its range"),
      std::string::npos);
}

TEST_F(CsvLayouts, NamesMayHaveColonsAndDigits) {
  const auto two = [](double t, bool level) {
    return fmt::format("{:.0f},0,{}\n", 1e9 * t, level ? 1 : 0);
  };
  for (const char* name : {"rx[0:0]", "3V3-rail", "1-Wire", "5V/A"})
    expect_read(std::string("time_ns,en,") + name + "\n" + rows(1 / 3000.0, two), name);
  const auto volt = [](double t, bool level) {
    return fmt::format("{:.6f},{}\n", t, volts(level));
  };
  for (const char* name : {"\u7535\u538b", "\u0435", "\u00f5"})  // e7 94 b5 e5 8e 8b, d0 b5, c3 b5
    expect_read(std::string("Time (s),") + name + "(V)\n" + rows(1 / 3000.0, volt),
                std::string(name) + "(V)", {"--channel", name});
  expect_read("time_s,rx_s,rx\n" + rows(1 / 3000.0,
                                        [](double t, bool level) {
                                          return fmt::format("{:.6f},0.5,{}\n", t, volts(level));
                                        }),
              "rx", {"--channel", "rx"});
}

TEST_F(CsvLayouts, ARateForRowsWithTimesIsRefused) {
  write("t.csv", "Time (s),CH1\n" + samples_at(1));
  expect_refused({"decode", "t.csv", "--sample-rate", "3kHz"}, 2,
                 "--sample-rate in t.csv:1 (rows have times of their own) leave it out");
}

TEST_F(CsvLayouts, RowsBehindASeparator) {
  const auto one = [](const std::string& separator) { return samples_alone(separator); };
  expect_read(
      "\"Header Size\",15\n\"TraceName\",\"CH1\"\n\"VUnit\",\"V\"\n\"SampleRate\",3000\n"
      "\"HResolution\",3.333333E-04\n\"Date\",\"2026/11/25\"\n\"Time\",\"12:00:00.00\"\n" +
          one(","),
      "CH1");
  expect_read(
      "LabVIEW Measurement\t\nWriter_Version\t2\n***End_of_Header***\t\nSamples\t1080\n"
      "Date\t2026/11/25\nX_Dimension\tTime\nDelta_X\t3.333333E-4\n***End_of_Header***\t\n"
      "X_Value\tRX\tComment\n" +
          one("\t"),
      "RX");
}

TEST_F(CsvLayouts, NamesOfSourcesStandBeforeUnits) {
  const auto two = [](double t, bool level) {
    return fmt::format("{:.6f},0.00,{}\n", t, volts(level));
  };
  expect_read("Horizontal Units,us,\nSource,CH1,CH2\nSecond,Value,Value\n" + rows(1 / 3000.0, two),
              "CH2");
  expect_read("Sample Rate,3000.0\nHorizontal Scale, 0.001000000\nSecond,Volt\n" + samples_at(1),
              "1");
}

}  // namespace
