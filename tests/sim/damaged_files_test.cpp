// Whatever is done to the bytes of an HDF5 file, each command that reads it does its work or
// refuses the file in a line, soon and in little memory. COSYS_DAMAGED_FILES=20000 tries so many of
// each kind of file, COSYS_DAMAGED_FILES=17-17 the one of that number.
#include <sys/stat.h>

#include <chrono>
#include <cstring>
#include <ctime>
#include <optional>
#include <utility>

#include "damage.hpp"
#include "program.hpp"
#include "sanitized.hpp"
#include "sim/failure.hpp"
#include "sim/link_experiment/link_columns.hpp"
#include "sim/result/store.hpp"
#include "sim/result/stored_result.hpp"
#include "small_experiments.hpp"

namespace sim {
namespace {

using test::is_sanitized;

constexpr double longest_s = 10;
constexpr bool counts_memory = !is_sanitized;  // what was freed is kept, and has a shadow
constexpr long most_kb = 1'000'000;

/// What a user has, how it is made, and what is done with it: the commands take turns.
struct KindOfFile {
  const char* name;
  std::string scenario;
  Words made_by;               // good.h5, of s.toml
  std::vector<Words> read_by;  // bad.h5
};

const Words report{"report", "bad.h5", "-o", "r.html"};
const Words diff{"diff", "bad.h5", "good.h5"};
const Words merge{"merge", "bad.h5", "-o", "sum.h5"};
const Words resume{"run", "link.toml", "-q", "--resume", "-o", "bad.h5"};
const Words check{"check", "s.toml", "--baseline", "bad.h5", "-q", "-t", "1"};
const Words decode{"decode", "bad.h5"};
const Words decode_light{"decode", "bad.h5", "--channel", "irradiance_mw_per_m2"};

const char* const small_link =
    "[simulation]\nwarmup_messages = 0\nsample_rate_hz = 250000\n"
    "[stop]\nmax_frames = 8\nmax_frame_errors = 0\n[sweep]\nreceiver.range_m = [0.5, 1]\n";
const char* const small_check =
    "[receiver]\nmodule = 'TSSP4056'\nrange_m = 2\n"
    "[simulation]\nfidelity = 'envelope'\nwarmup_messages = 0\n"
    "[stop]\nmax_frames = 4\n[sweep]\ndevice.clock_error_ppm = [0, 10]\n";

KindOfFile kind_of(const test::Experiment& experiment) {
  return {experiment.name,
          scenario_of(experiment, true),
          {"run", "s.toml", "-q", "-o", "good.h5"},
          {report, report, report, diff, report, report, merge, report, resume, check, decode}};
}

std::vector<KindOfFile> kinds() {
  std::vector<KindOfFile> all{
      {"link",
       small_link,
       {"run", "s.toml", "-q", "-o", "good.h5"},
       {diff, merge, resume, diff, report, merge, diff, check, resume, decode}},
      {"baseline",
       small_check,
       {"baseline", "s.toml", "-q", "-o", "good.h5"},
       {check, check, check, report, check, check, diff, check, merge, check, resume, decode}},
      {"capture",
       small_link,
       {"trace", "s.toml", "-o", "good.h5"},
       {decode, decode_light, decode, decode_light, check, decode, decode_light, diff, decode,
        merge, decode_light, resume, report}}};
  for (const test::Experiment& experiment : test::small_experiments)
    all.push_back(kind_of(experiment));
  return all;
}

KindOfFile kind(const std::string& name) {
  for (const KindOfFile& one : kinds())
    if (one.name == name) return one;
  throw std::runtime_error("no kind " + name);
}

/// Of a kind; the builds of the weekly run share 200, of which the slower one has fewer. In a gate
/// each command of `read_by` has one at least.
std::pair<std::uint64_t, std::uint64_t> usual_mutants() {
  if (is_sanitized) return {0, 30};
  if (test::is_set("COSYS_WEEKLY")) return {30, 200};
  return {30, 45};
}

/// The numbers of mutants to be tried: first and behind the last.
std::pair<std::uint64_t, std::uint64_t> mutants() {
  const char* const wanted = std::getenv("COSYS_DAMAGED_FILES");
  if (wanted == nullptr) return usual_mutants();
  char* end = nullptr;
  const std::uint64_t number = std::strtoull(wanted, &end, 10);
  if (*end != '-') return {0, number};
  return {number, std::strtoull(end + 1, nullptr, 10) + 1};
}

bool is_allowed(const std::string& command, int code) {
  if (code == 1) return command == "check" || command == "diff";
  if (code == 4) return command == "check" || command == "decode";
  return code == 0 || code == 2;
}

/// What no command may do; empty if it did well.
std::string fault_in(const Outcome& o, const std::string& command, double seconds) {
  if (!is_allowed(command, o.code)) return "exit code " + std::to_string(o.code) + ": " + o.err;
  const std::string err = test::without_refused_sizes(o.err);
  if (err.find("Sanitizer") != std::string::npos) return "the sanitizer's: " + err;
  const bool is_line =
      err.starts_with("cosys-sim: ") && err.ends_with('\n') && std::ranges::count(err, '\n') == 1;
  if (o.code == 2 && !is_line) return "no clear line: " + err;
  if (o.code == 2 && !o.out.empty() && command != "decode") return "an answer, and refused";
  if (seconds > longest_s) return std::to_string(seconds) + " s";
  if (counts_memory && o.peak_kb > most_kb) return std::to_string(o.peak_kb) + " kB of memory";
  return "";
}

std::string in_one_line(const Words& words) {
  std::string line;
  for (const std::string& word : words) line += " " + word;
  return line;
}

class FileOfAKind : public CommandLine {
 protected:
  void make(const KindOfFile& made) const {
    write("s.toml", made.scenario);
    write("link.toml", small_link);
    const Outcome o = program(made.made_by);
    ASSERT_EQ(o.code, 0) << o.err;
  }

  /// What goes wrong with `command`; empty if nothing. What takes too long is tried again, and its
  /// time told as of a processor of its own: a machine that does other things may be slow.
  std::string fault_of(const Words& command, int& code) const {
    Timed last = timed(command);
    if (last.seconds > longest_s) {
      last = timed(command);
      last.seconds *= share_of_a_processor();
    }
    code = last.outcome.code;
    return fault_in(last.outcome, command.front(), last.seconds);
  }

 private:
  struct Timed {
    Outcome outcome;
    double seconds;
  };

  using Clock = std::chrono::steady_clock;

  /// What this process gets now.
  static double share_of_a_processor() {
    constexpr std::clock_t spun = CLOCKS_PER_SEC / 20;
    const auto begin = Clock::now();
    for (const std::clock_t first = std::clock(); std::clock() - first < spun;) continue;
    const std::chrono::duration<double> took = Clock::now() - begin;
    return std::min(1.0, static_cast<double>(spun) / CLOCKS_PER_SEC / took.count());
  }

  /// Killed if it takes six times as long as it may.
  Timed timed(const Words& command) const {
    Words words{"--signal=KILL", std::to_string(6 * static_cast<int>(longest_s)), COSYS_PROGRAM};
    words.insert(words.end(), command.begin(), command.end());
    const auto begin = Clock::now();
    Outcome outcome = start_tool("timeout", words).finish();
    const std::chrono::duration<double> took = Clock::now() - begin;
    return {std::move(outcome), took.count()};
  }
};

class DamagedFiles : public FileOfAKind, public testing::WithParamInterface<const char*> {
 protected:
  /// The exit code of `command` on bad.h5 with these bytes. The file of a fault is kept.
  int code_of(const std::string& bytes, const Words& command, const std::string& name) const {
    write("bad.h5", bytes);
    int code = 0;
    const std::string fault = fault_of(command, code);
    if (fault.empty()) return code;
    const auto kept = std::filesystem::temp_directory_path() / ("cosys_" + name + ".h5");
    std::ofstream(kept, std::ios::binary) << bytes;
    ADD_FAILURE() << name << " (kept as " << kept.string() << "):" << in_one_line(command) << ": "
                  << fault;
    return code;
  }
};

TEST_P(DamagedFiles, AreReadOrRefusedInALine) {
  const KindOfFile tried = kind(GetParam());
  make(tried);
  const test::Damage damage(content(path("good.h5")));
  const auto [first, end] = mutants();
  std::uint64_t refused = 0;
  for (std::uint64_t number = first; number < end; ++number) {
    const Words& command = tried.read_by[number % tried.read_by.size()];
    const std::string name = tried.name + ("_" + std::to_string(number));
    refused += code_of(damage.damaged(number), command, name) == 2 ? 1 : 0;
  }
  if (end - first < 100) return;  // too few to tell
  EXPECT_GT(refused, (end - first) / 4);
  EXPECT_LT(refused, end - first);
}

const auto name_of_kind = [](const auto& test) { return std::string(test.param); };
INSTANTIATE_TEST_SUITE_P(Link, DamagedFiles, testing::Values("link"), name_of_kind);
INSTANTIATE_TEST_SUITE_P(Baseline, DamagedFiles, testing::Values("baseline"), name_of_kind);
INSTANTIATE_TEST_SUITE_P(Capture, DamagedFiles, testing::Values("capture"), name_of_kind);
INSTANTIATE_TEST_SUITE_P(Air, DamagedFiles, testing::Values("arena", "guard"), name_of_kind);
INSTANTIATE_TEST_SUITE_P(Place, DamagedFiles, testing::Values("presence", "location"),
                         name_of_kind);
INSTANTIATE_TEST_SUITE_P(Talk, DamagedFiles, testing::Values("sharedlink", "listening"),
                         name_of_kind);

// ---- what chance hardly finds ----

class HostileFile : public FileOfAKind {
 protected:
  HostileFile() { write("link.toml", small_link); }

  /// Each command refuses bad.h5.
  void expect_refused_by(const std::vector<Words>& commands) const {
    for (const Words& command : commands) {
      int code = 0;
      EXPECT_EQ(fault_of(command, code), "") << in_one_line(command);
      EXPECT_EQ(code, 2) << in_one_line(command);
    }
  }

  static void put(std::string& bytes, std::size_t place, std::uint64_t number) {
    std::memcpy(bytes.data() + place, &number, sizeof number);
  }
};

// What a run writes to is refused as such.
TEST_F(HostileFile, PipesAreNotWaitedFor) {
  make(kind("link"));
  ASSERT_EQ(::mkfifo(path("bad.h5").c_str(), 0600), 0);
  expect_refused_by({report, diff, merge, check, decode});
}

// A text of the heap that goes on where the heap begins.
TEST_F(HostileFile, RingsAreLeft) {
  make(kind("baseline"));
  std::string bytes = content(path("good.h5"));
  constexpr std::size_t head_of_heap = 16, head_of_text = 16;
  const std::size_t heap = bytes.find("GCOL");
  ASSERT_NE(heap, std::string::npos);
  put(bytes, heap + head_of_heap + 8, std::uint64_t{0} - head_of_text);
  write("bad.h5", bytes);
  expect_refused_by({report, check, decode});
}

TEST_F(HostileFile, RowsThatNobodyWroteAreNotMadeUp) {
  make(kind("capture"));
  std::string bytes = content(path("good.h5"));
  const auto count = NetcdfReader(path("good.h5")).size("rx");
  const std::string rows(reinterpret_cast<const char*>(&count), sizeof count);
  int changed = 0;
  for (auto at = bytes.find(rows); at != std::string::npos; at = bytes.find(rows, at + 1)) {
    put(bytes, at, std::uint64_t{1} << 60U);
    ++changed;
  }
  ASSERT_GT(changed, 2);
  write("bad.h5", bytes);
  expect_refused_by({decode, decode_light});
}

TEST_F(HostileFile, ReasonsToStopThatThereAreNotAreRefused) {
  make(kind("link"));
  StoredResult stored = read_result(path("good.h5"));
  for (const int reason : {-1, 5, 32767}) {
    SCOPED_TRACE(reason);
    stored.result.points.back().stop = static_cast<StopReason>(reason);
    write_dataset(path("bad.h5"), link_dataset(stored.result), stored.origin.program);
    expect_refused_by({report, diff, merge});
  }
}

}  // namespace
}  // namespace sim
