#pragma once
// What the program does, one function a command: results to stdout, messages to stderr, an exit
// code back. Wrong input and a failing machine are thrown as Failure.
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sim/check/program_decoder.hpp"
#include "sim/check/sequential_test.hpp"
#include "sim/command/usage.hpp"
#include "sim/components/parts.hpp"
#include "sim/counting/shard.hpp"
#include "sim/failure.hpp"
#include "sim/program_info.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/serve/serve_settings.hpp"
#include "sim/trace/trace_wishes.hpp"

namespace sim {

/// What all commands on a scenario take.
struct ScenarioOptions {
  std::vector<std::string> overrides;  // --set and its short forms
  PartRoots parts;                     // --parts, then one of the program's own
};

/// Folders of parts: what is beside the scenario comes before all others.
PartRoots part_roots(const ScenarioOptions& options, const std::filesystem::path& scenario);

LoadedScenario load_with(const ScenarioOptions& options, const std::filesystem::path& scenario);

/// The same for commands that take nothing but links.
LoadedScenario load_link(const ScenarioOptions& options, const std::filesystem::path& scenario,
                         const std::string& command);

/// Throws where a scenario, which `command` is to take, is no experiment of a link.
void refuse_other_than_link(const LoadedScenario& scenario, const std::string& command);

struct RunRequest {
  std::vector<std::filesystem::path> scenarios;
  ScenarioOptions options;
  std::optional<std::filesystem::path> output;  // a file, or a folder for several scenarios
  int threads = 0;                              // 0: one per processor
  bool quiet = false, json = false;
  bool resume = false;  // go on with what the result files have
  Shard shard;
  bool table = false;        // a row for each point, however many there are
  bool plot = false;         // draw the ratios as characters
  bool profile = false;      // say where the time went
  bool plan = false;         // say what the run would take, and run nothing else
  double time_budget_s = 0;  // choose how much is run so that it takes so long; 0: as given
  std::string command;       // as the user typed it
  ProgramInfo program;
};
ExitCode run_command(const RunRequest& request);

struct TraceRequest {
  std::filesystem::path scenario;
  ScenarioOptions options;
  std::uint64_t point = 0;
  std::uint32_t trial = 0;
  std::filesystem::path output;
  TraceWishes wishes;
  ProgramInfo program;
};
ExitCode trace_command(const TraceRequest& request);

struct EncodeRequest {
  std::string message, protocol = "cosys";
};
/// The bytes of a message on the line, to stdout.
ExitCode encode_command(const EncodeRequest& request);

/// How captures are read.
struct CaptureOptions {
  std::string wire;                      // empty: by what is on the wires
  std::string format;                    // empty: by its ending or content
  std::optional<double> sample_rate_hz;  // nothing: as the file says
  std::optional<int> sample_bytes;       // nothing: 1, of formats that do not say it
  std::optional<dsp::Seconds> tick;      // unit of time, of formats that do not say it
  std::size_t skip_rows = 0;             // of a table: lines passed over
};

struct DecodeRequest : CaptureOptions {
  std::vector<std::filesystem::path> captures;  // or folders of such
  std::string uart = "atmega";
  std::optional<double> baud;        // nothing: found in the capture
  std::optional<double> carrier_hz;  // nothing: found in the capture; 0: none
  std::string polarity = "auto";     // or "idle-high", "idle-low"
  std::string protocol = "cosys";
  bool json = false;
};
ExitCode decode_command(const DecodeRequest& request);

struct NodeRequest {
  std::filesystem::path lists;                                   // TOML: see sim/node/node_file.hpp
  std::optional<std::filesystem::path> device, pseudo_terminal;  // one of the two
  std::optional<double> baud;                                    // not that of the file
  double duration_s = std::numeric_limits<double>::infinity();
};
/// One end of a SharedLink, until its time is over or a signal comes.
ExitCode node_command(const NodeRequest& request);

struct ServeRequest {
  std::filesystem::path scenario;
  ScenarioOptions options;
  std::filesystem::path link = "ttyCOSYS";
  ServeSettings settings;
  bool json = false;
};
/// Plays a link's line on a virtual serial port, until its time is over, "quit" or a signal comes.
ExitCode serve_command(const ServeRequest& request);

struct FindRequest {
  std::filesystem::path scenario;
  ScenarioOptions options;
  double flr = 0.01;        // the level
  std::string over;         // "receiver.range_m=1:40", or a key that the scenario sweeps
  double tolerance = 0.01;  // of the value to be found, relative
  std::optional<std::filesystem::path> output;
  int threads = 0;  // 0: one per processor
  bool json = false;
  std::string command;  // as the user typed it
  ProgramInfo program;
};
/// Where along a key the frame loss passes a level.
ExitCode find_command(const FindRequest& request);

struct MergeRequest {
  std::vector<std::filesystem::path> results;  // at least one
  std::filesystem::path output;
  std::string command;  // as the user typed it
  ProgramInfo program;
};
/// Adds shards of one experiment up.
ExitCode merge_command(const MergeRequest& request);

/// For each picture of a report by itself; nothing where none of the kind are wanted. A `pdf` that
/// ends in .pdf is a file, the report for print.
struct PictureFolders {
  std::optional<std::filesystem::path> svg, png, pdf;
};
struct ReportRequest {
  std::vector<std::filesystem::path> results;  // at least one
  std::filesystem::path output = "report.html";
  PictureFolders pictures;
  int threads = 0;  // 0: one per processor
};
ExitCode report_command(const ReportRequest& request);

struct DiffRequest {
  std::filesystem::path one, other;  // result files
  double alpha = 0.01;
};
/// Whether two results say the same; check_failed if not.
ExitCode diff_command(const DiffRequest& request);

struct CheckRequest {
  std::vector<std::filesystem::path> scenarios;
  ScenarioOptions options;
  std::filesystem::path baseline;
  std::string decoder;  // a name, or a command; empty: the baseline's
  ProgramSettings program_settings;
  SequentialTestRule rule = rule_of_checks;
  std::uint64_t frames = 0;            // of each point at most; 0: as many as the baseline has
  std::optional<std::uint64_t> point;  // of each scenario; nothing: all
  bool golden = false;                 // no frame may come out otherwise
  // One frame in place of the check.
  std::optional<std::uint32_t> explain;   // say what was sent, seen and read of it
  std::optional<std::uint32_t> minimise;  // look for the least that only the candidate loses it by
  bool init = false;                      // in place of the check: write the workflows that run it
  std::optional<std::filesystem::path> junit, summary;
  std::optional<std::filesystem::path> output;  // a table: .csv or .json
  int threads = 0;                              // 0: one per processor
  bool quiet = false, json = false;
  ProgramInfo program;
};
/// Whether a decoder is worse than its baseline: check_failed if it is, inconclusive if the frames
/// do not tell.
ExitCode check_command(const CheckRequest& request);

struct BaselineRequest {
  std::vector<std::filesystem::path> scenarios;  // none: those of the baseline that is there
  ScenarioOptions options;
  std::filesystem::path output;
  std::string decoder;  // a name, or a command; empty: as the baseline has it, else the scenario
  ProgramSettings program_settings;
  std::optional<double> detect;  // so many times as many lost frames; each point has the frames
                                 // that it takes to find them
  double power = 0.95;           // how surely a check shall see
  int threads = 0;               // 0: one per processor
  bool quiet = false;
  std::string command;  // as the user typed it
  ProgramInfo program;
};
/// Writes what a decoder makes of scenarios, to judge others by, and says what is other than in the
/// baseline that it replaces.
ExitCode baseline_command(const BaselineRequest& request);

struct CompareRequest {
  std::vector<std::filesystem::path> scenarios;
  ScenarioOptions options;
  std::vector<std::string> decoders;  // names, or commands; none: all that are built in
  ProgramSettings program_settings;   // of commands
  double alpha = 1e-3;                // of telling two apart that are alike, all together
  int threads = 0;                    // 0: one per processor
  bool quiet = false, json = false;
};
/// Which of some decoders loses least of the same light, and where.
ExitCode compare_command(const CompareRequest& request);

struct PartsRequest {
  std::string name;    // of the part to show; empty: list all
  std::string search;  // of a list: only parts whose file mentions this
  PartRoots parts;     // --parts, then the program's own
  bool json = false;
};
ExitCode parts_command(const PartsRequest& request);

struct LocateRequest {
  std::filesystem::path readings;  // or a scenario of location, by its ending .toml
  ScenarioOptions options;         // --parts is for both
  // Of a scenario.
  std::uint64_t point = 0;
  std::uint32_t trial = 0;
  // Of readings.
  std::string led = "TSAL6200", floor = "indoor", photodiode = "BPW34";
  double led_current_ma = 100;
  std::optional<double> led_yaw_deg;        // nothing: as bright to all sides
  double height_mm = 10;                    // of LED and receivers
  std::optional<std::vector<double>> area;  // x from, to, y from, to in metres
  bool intensity_unknown = false;
  std::vector<std::string> given;               // names of all options that were: "--led"
  std::optional<std::filesystem::path> output;  // a table: .csv or .json
  bool json = false;
};
/// Where readings of light, measured or drawn, say that a device is; inconclusive if they leave it
/// open.
ExitCode locate_command(const LocateRequest& request);

struct FitRequest : CaptureOptions {
  std::vector<std::filesystem::path> captures;    // none: a bench is written
  bool plan = false;                              // --plan is given
  std::vector<std::filesystem::path> plan_files;  // with it: of all captures, or of each
  std::optional<std::filesystem::path> output;    // the bench's folder, or the part's file
  std::optional<std::filesystem::path> page;
  double minutes = 5;
  std::string module = "TSOP4856";  // like the one to be measured
  /// Of the plan's first step, of the first capture or of each; nothing: as it says.
  std::vector<double> irradiances_mw_per_m2;
  std::vector<double> ambients_w_per_m2;  // of a lamp, of each capture; none: no lamp
  std::string drive;                      // wire that drives the LED; empty: none is named
  std::optional<double> carrier_hz;       // of the light where a wire has none
  std::string message;                    // that a device sent; empty: as is decoded
  std::optional<double> baud;             // of messages
  std::string polarity = "auto";          // or "idle-high", "idle-low"
  PartRoots parts;                        // --parts, then the program's own
  std::vector<std::string> given;         // names of all options that were: "--minutes"
  bool quiet = false, json = false;
};
/// What it takes to measure a receiver module, or its constants out of captures of its output;
/// inconclusive where these tell none.
ExitCode fit_command(const FitRequest& request);

/// The two that it is: files of a bench, and constants.
ExitCode bench_command(const FitRequest& request);
ExitCode measure_command(const FitRequest& request);

struct CompletionRequest {
  std::string shell;  // "bash", "zsh" or "fish"
  PartRoots parts;
};
/// A script for it, to stdout.
ExitCode completion_command(const CompletionRequest& request, ProgramUsage usage);

struct ManualRequest {
  ProgramInfo program;
  std::string date;  // of the commit
};
/// The manual page, to stdout.
ExitCode manual_command(const ManualRequest& request, const ProgramUsage& usage);

}  // namespace sim
