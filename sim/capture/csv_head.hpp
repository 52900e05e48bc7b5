#pragma once
// What the lines above the rows of a CSV file say, or those beside them: names and units of the
// columns in either order, and how rows lie in time. Known layouts, and where they are documented:
//
// * sigrok-cli -O csv: "; Samplerate: 1 MHz", "; Channels (2/2): rx, tx" (libsigrok,
//   src/output/csv.c)
// * Saleae Logic 2: "Time [s],Channel 0" (support.saleae.com, "Export data file formats")
// * Tektronix TDS, TBS, TPS: "Sample Interval,4e-06,,-0.01,3.2,", the head beside the rows (TDS1000
//   manual, "Save/Recall")
// * Rigol DS1000: "X,CH1,Start,Increment," and a row of the two numbers; DS1000Z: "Time(s),CH1(V),
//   t0 = .., tInc = .."
// * Keysight, Agilent: "x-axis,1,2" above "second,Volt,Volt" (InfiniiVision user's guide, "Save")
// * Rohde & Schwarz: "in s,CH1 in V" (RTB2000 manual, "Waveform export")
// * GW Instek, Owon, Hantek: "Sampling Period,4e-06," and one column of numbers
// * PicoScope: names above "(ms),(V)" (PicoScope 6 user's guide, "Text formats")
// * numpy.savetxt: "# time_us,rx" (its parameter `header`)
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dsp/units.hpp"
#include "sim/capture/capture_units.hpp"

namespace sim {

/// Whether a line is one to people alone: "; ...", "# ...", "% ...", or empty.
bool is_remark(std::string_view line);

std::vector<std::string> without_empty_end(std::vector<std::string> fields);

/// Lines of a head, told one after the other; what they cannot mean is thrown with the words that
/// the file has.
class CsvHead {
 public:
  /// The fields, trimmed, of line `number`, which is no row of numbers.
  void read(const std::vector<std::string>& all, std::string_view line, std::size_t number);

  /// The same of a line whose fields stand beside a row: they name no columns.
  void read_beside(const std::vector<std::string>& fields, std::size_t number);

  /// Of that many columns: names and units of the head's last line of as many fields, be it a
  /// remark where no other has them; their numbers where there is none.
  std::vector<Heading> columns(std::size_t count) const;
  /// The line of the units, else of the names.
  std::size_t line_of_units(std::size_t count) const;

  std::optional<dsp::Hertz> sample_rate() const { return sample_rate_; }
  /// Whether sigrok wrote it.
  bool is_of_sigrok() const { return is_of_sigrok_; }

  /// "Start" and "Increment" behind the names: rows count from the start on.
  bool has_grid_names() const { return grid_field_ > 0; }
  struct Grid {
    double start, increment;
  };
  const std::optional<Grid>& grid() const { return grid_; }

  /// A rate or interval that has a unit which nobody knows: "Sample Interval (fortnight)".
  struct Unknown {
    std::string word, of;
    std::size_t line = 0;
  };
  const std::optional<Unknown>& unknown() const { return unknown_; }

 private:
  struct Row {
    std::vector<std::string> fields;
    std::size_t line = 0;
  };
  struct NamesAndUnits {
    const Row *names = nullptr, *units = nullptr;
  };

  NamesAndUnits rows_of(std::size_t count) const;
  Heading heading(std::size_t column, std::size_t count, const NamesAndUnits& rows) const;
  bool read_remark(std::string_view line);
  bool read_timing(const std::vector<std::string>& fields, std::string_view line,
                   std::size_t number);
  bool read_grid(const std::vector<std::string>& fields);
  void take_rate(const std::string& key, const std::string& value, const std::string& unit,
                 std::size_t number);
  void take_interval(const std::string& key, const std::string& value, const std::string& unit,
                     std::size_t number);

  std::vector<Row> rows_;              // of names or units, as they came
  std::optional<Row> remark_;          // the last line, if it is one
  std::vector<std::string> channels_;  // of sigrok's remark
  std::string source_;                 // "Source,CH1" beside the rows
  bool is_of_sigrok_ = false;
  std::optional<dsp::Hertz> sample_rate_;
  std::size_t grid_field_ = 0;
  std::optional<Grid> grid_;
  std::optional<Unknown> unknown_;
};

}  // namespace sim
