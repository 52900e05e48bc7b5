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
// * Siglent: "Source,CH1,CH2" above "Second,Value,Value" (what binary-to-CSV and the SDS1000X
// write)
// * Infiniium: "XInc:,1.04e-05" (Infiniium help, "CSV and TSV files")
// * Yokogawa DLM: "HResolution",1.04e-05,... and rows that begin with a comma (IM DLM3054-01EN,
//   appendix 3)
// * LabVIEW's .lvm: Delta_X, and a column Comment that no row has ("Specification for the LabVIEW
//   Measurement File")
// * numpy.savetxt: "# time_us,rx" (its parameter `header`)
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dsp/units.hpp"
#include "sim/capture/capture_units.hpp"

namespace sim {

/// Lines of a head, told one after the other.
class CsvHead {
 public:
  /// The fields of line `number`, which is no row of numbers.
  void read(const std::vector<std::string>& all, std::string_view line, std::size_t number);

  /// The same of a line whose fields stand beside a row: they name no columns.
  void read_beside(const std::vector<std::string>& fields, std::size_t number);

  /// Where the columns of rows stand in their lines.
  struct Columns {
    std::size_t first = 0, count = 0;
    bool first_is_time = false;  // its cells are more than 0 and 1
  };
  /// Names and units: of the head's last lines of as many fields, be it a remark where no other has
  /// them; their numbers where there is none.
  std::vector<Heading> columns(const Columns& columns) const;
  /// The line of the units, else of the names.
  std::size_t line_of_units(const Columns& columns) const;

  std::optional<dsp::Hertz> sample_rate() const { return sample_rate_; }
  /// Whether sigrok wrote it.
  bool is_of_sigrok() const { return is_of_sigrok_; }

  /// "Start" and "Increment" behind the names: rows count from the start on.
  bool has_grid_names() const { return grid_field_ > 0; }
  struct Grid {
    double start, increment;
  };
  const std::optional<Grid>& grid() const { return grid_; }

  /// What the head says and is not understood, or belongs to no column.
  struct Unknown {
    std::string word, of;
    std::size_t line = 0;
    const char* why = "it is in no unit that is known here";
  };
  /// A rate or interval in a unit that nobody knows: "Sample Interval (fortnight)".
  const std::optional<Unknown>& unknown() const { return unknown_; }
  /// A unit of time other than seconds that belongs to none of the columns: "Time unit: ms".
  std::optional<Unknown> unit_of_no_column(const Columns& columns) const;

 private:
  struct Row {
    std::vector<std::string> fields;
    std::size_t width = 0;  // fields, empty ones at the end too
    std::size_t line = 0;

    bool has(std::size_t count) const { return fields.size() <= count && width >= count; }
    std::string field(std::size_t place) const {
      return place < fields.size() ? fields[place] : "";
    }
  };
  struct NamesAndUnits {
    const Row *names = nullptr, *units = nullptr;
  };

  NamesAndUnits rows_of(std::size_t count) const;
  const Row* wide_names(std::size_t count) const;
  const Row* names_in_remarks(std::size_t count) const;
  Heading heading(std::size_t column, const Columns& columns, const NamesAndUnits& rows) const;
  std::optional<Heading> sigrok_heading(std::size_t column, const Columns& columns,
                                        const NamesAndUnits& rows) const;
  static std::optional<Unknown> unit_in(const Row& row);
  bool read_remark(std::string_view line);
  bool read_timing(const std::vector<std::string>& fields, std::string_view line,
                   std::size_t number);
  bool read_timing(const std::string& key, const std::string& value, const std::string& unit,
                   std::size_t number);
  void read_timing_fields(std::vector<std::string>& fields, std::size_t number);
  bool read_grid(const std::vector<std::string>& fields);
  void take(std::optional<dsp::Hertz> rate, const Unknown& unknown);

  std::vector<Row> rows_, remarks_;    // of names or units, as they came
  std::vector<Row> beside_;            // of units, beside rows
  std::vector<std::string> channels_;  // of sigrok's remark
  std::string source_;                 // "Source,CH1"
  bool is_of_sigrok_ = false;
  std::optional<dsp::Hertz> sample_rate_;
  std::size_t grid_field_ = 0;
  std::optional<Grid> grid_;
  std::optional<Unknown> unknown_;
};

}  // namespace sim
