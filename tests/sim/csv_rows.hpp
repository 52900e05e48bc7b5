#pragma once
// One COSYS message as rows of a table, and what decode says that it read of the table.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "decoded_line.hpp"
#include "program.hpp"
#include "protocol/cosys.hpp"

namespace sim::test {

inline constexpr double message_begin_s = 0.03, message_bit_s = 1 / 600.0;

/// The line of "IND 011111 OK" at a time, idle high.
inline bool level_at(double time) {
  static const protocol::Bytes bytes = protocol::cosys_encode("IND 011111 OK");
  const double slot = std::floor((time - message_begin_s) / message_bit_s + 1e-9);
  if (slot < 0) return true;
  const auto byte = static_cast<std::size_t>(slot / 10);
  if (byte >= bytes.size()) return true;
  return protocol::line_bit(bytes[byte], static_cast<int>(slot) % 10);
}

/// Rows every `step` for 0.36 s, each by `row` of its time and level.
inline std::string rows(double step, const std::function<std::string(double, bool)>& row) {
  std::string text;
  for (int i = 0; i * step < 0.36; ++i) text += row(i * step, level_at(i * step));
  return text;
}

/// Rows where the level changes alone; times in `unit`, without decimals.
inline std::string changes(double unit, const std::string& more = "") {
  std::string text = "0,1" + more + "\n";
  bool last = true;
  for (int slot = 0; slot < 190; ++slot) {
    const double time = message_begin_s + slot * message_bit_s;
    if (level_at(time) == last) continue;
    last = !last;
    text += fmt::format("{:.0f},{}{}\n", time / unit, last ? 1 : 0, more);
  }
  return text;
}

class CsvFile : public CommandLine {
 protected:
  nlohmann::json line_of(const std::string& text, const Words& options = {}, int code = 0) const {
    write("t.csv", text);
    Words words{"decode", "t.csv", "--json"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome o = program(words);
    EXPECT_EQ(o.code, code) << o.err << text.substr(0, 200);
    EXPECT_NE(o.out.find("\"IND 011111 OK\",\"outcome\":\"ok\""), std::string::npos)
        << o.out << text.substr(0, 200);
    return line_facts(o.out);
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

inline std::string volts(bool level) { return level ? "3.32" : "0.04"; }

/// A column of volts, without a time.
inline std::string samples_alone(const std::string& before = "", const std::string& behind = "") {
  return rows(1 / 3000.0,
              [&](double, bool level) { return before + volts(level) + behind + "\n"; });
}

/// Times in units of `unit`, and volts.
inline std::string samples_at(double unit, const std::string& before = "",
                              const std::string& behind = "") {
  return rows(1 / 3000.0, [&](double t, bool level) {
    return fmt::format("{}{:.6f},{}{}\n", before, t / unit, volts(level), behind);
  });
}

}  // namespace sim::test
