// Tables as instruments and programs write them (sim/capture/csv_head.hpp names each and where its
// layout is documented): one COSYS message in every layout, and what decode says that it read.
#include "csv_rows.hpp"

namespace sim::test {
namespace {

class CsvLayouts : public CsvFile {};

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

TEST_F(CsvLayouts, RowsThatBeginWithNothingAreRows) {
  const auto two = [n = 0](double, bool level) mutable {
    return fmt::format("{},{}\n", n++ < 40 ? "X" : "1", level ? 1 : 0);
  };
  const auto line = line_of("tx,rx\n" + rows(1 / 3000.0, two), {"--sample-rate", "3000"});
  EXPECT_EQ(line.at("capture").at("channel"), "rx");
  EXPECT_EQ(line.at("capture").at("channels").size(), 2U);
}

TEST_F(CsvLayouts, NamesBehindAMark) { expect_read("# time_us,rx\n" + changes(1e-6), "rx"); }

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

TEST_F(CsvLayouts, FewSamplesABit) {
  expect_read("; Samplerate: 2 kHz\nrx\n" +
                  rows(1 / 2000.0, [](double, bool level) { return level ? "1\n" : "0\n"; }),
              "rx");
}

TEST_F(CsvLayouts, IdleIsWhatLiesBetweenCharacters) {
  std::string text = "Time [s],rx\n0,0\n2,1\n";  // no supply at first
  bool last = true;
  for (int slot = 0; slot < 190; ++slot) {
    const double time = message_begin_s + slot * message_bit_s;
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

TEST_F(CsvLayouts, WhatStandsAboveALateHeadIsToBeSkipped) {
  write("late.csv", "0.1,0\n0.2,1\nTime (us),rx\n" + changes(1e-6));
  expect_refused({"decode", "late.csv"}, 2,
                 "'Time (us),rx' in late.csv:3 (a head of columns stands below rows of numbers) "
                 "leave out what is above it: --skip-rows 2");
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
}  // namespace sim::test
