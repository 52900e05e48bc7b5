#include "sim/check/program_decoder.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <optional>
#include <vector>

#include "protocol/cosys.hpp"
#include "sim/check/capture_folder.hpp"
#include "sim/check/child_process.hpp"
#include "sim/check/line_capture.hpp"
#include "sim/failure.hpp"
#include "sim/text/list_text.hpp"
#include "sim/text/number_text.hpp"
#include "sim/text/shell_text.hpp"
#include "sim/text/spelling.hpp"
#include "sim/threads/stop_signals.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

/// Of a capture's hundred messages: what goes on for ever is ended before it takes the memory.
constexpr std::size_t most_output = std::size_t{4} << 20U;

/// What a program has to end in order, once nothing is asked of it any more.
constexpr std::chrono::seconds farewell{5};

std::string in_braces(const LineCapture& format) { return std::string("{") + format.name + "}"; }

/// The format that the command asks for; edges without one.
const LineCapture& format_of(const std::string& command) {
  const LineCapture* found = nullptr;
  std::string words;
  for (const LineCapture& format : line_captures()) {
    words += " " + in_braces(format);
    if (command.find(in_braces(format)) == std::string::npos) continue;
    if (found != nullptr)
      throw bad_input("--decoder " + command, "it asks for two formats", "ask for one");
    found = &format;
  }
  if (found != nullptr) return *found;
  const auto edges = std::ranges::find_if(
      line_captures(), [](const LineCapture& f) { return std::strcmp(f.name, "edges") == 0; });
  return *edges;
}

std::string replaced(std::string text, const std::string& word, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += by.size())
    text.replace(at, word.size(), by);
  return text;
}

/// A capture that is there as long as this.
class CaptureFile {
 public:
  CaptureFile(CaptureFolder& folder, const char* ending, const std::string& bytes)
      : folder_(folder), path_(folder.write(ending, bytes)) {}
  CaptureFile(const CaptureFile&) = delete;
  CaptureFile& operator=(const CaptureFile&) = delete;
  ~CaptureFile() { folder_.remove(path_); }

  const fs::path& path() const { return path_; }

 private:
  CaptureFolder& folder_;
  const fs::path path_;
};

/// Device messages in the bytes of a line.
std::vector<std::string> accepted_in_bytes(const std::string& bytes) {
  std::vector<std::string> accepted;
  protocol::CosysDecoder decoder;
  for (const char byte : bytes) {
    auto frame = decoder.push({dsp::Seconds(0), static_cast<std::uint8_t>(byte), false});
    if (frame && frame->outcome == protocol::CosysOutcome::ok)
      accepted.push_back(std::move(frame->message));
  }
  return accepted;
}

/// A line may have the checksum too, and a carriage return.
std::string message_of(std::string_view line) {
  std::string text(line);
  if (text.ends_with('\r')) text.pop_back();
  text = trimmed(text);
  const auto with_checksum = accepted_in_bytes(text + "\n");
  return with_checksum.empty() ? text : with_checksum.front();
}

std::vector<std::string> accepted_in_lines(const std::string& text) {
  std::vector<std::string> accepted;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    if (std::string message = message_of(rest.substr(0, end)); !message.empty())
      accepted.push_back(std::move(message));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return accepted;
}

std::string killed_by(int signal) {
  const char* what = ::sigdescr_np(signal);
  return fmt::format("killed by signal {} ({})", signal,
                     what == nullptr ? "a real-time signal" : what);
}

DecoderFault fault_of(Waited waited, const ChildProcess& child, const ProgramSettings& settings) {
  using enum DecoderFault::Kind;
  const int status = child.status();
  if (waited == Waited::timeout)
    return {timeout, fmt::format("no answer within {:g} s", settings.timeout.count()),
            child.words()};
  if (waited == Waited::too_much) return {garbage, "more than 4 MiB of output", child.words()};
  if (WIFSIGNALED(status)) return {killed, killed_by(WTERMSIG(status)), child.words()};
  if (status == 0) return {garbage, "it ended without an answer", child.words()};
  return {exit_code, fmt::format("exit code {}", WEXITSTATUS(status)), child.words()};
}

/// What the shell says of a command that is not there.
void refuse_missing(const DecoderFault& fault) {
  if (fault.what == "exit code 127" || fault.what == "exit code 126")
    throw Failure(ExitCode::environment, "the decoder cannot be started (" +
                                             last_line_of(fault.words) +
                                             ") install it, or give its path");
}

class ProgramDecoder : public Decoder {
 public:
  ProgramDecoder(std::string command, const ProgramSettings& settings)
      : command_(std::move(command)), settings_(settings), format_(format_of(command_)) {}

  const std::string& name() const override { return command_; }

 protected:
  const std::string& command() const { return command_; }
  const ProgramSettings& settings() const { return settings_; }
  const LineCapture& format() const { return format_; }

  /// Every capture has undisturbed messages, so none at all is not the light's fault.
  Decoded decoded(const std::string& output) const {
    auto accepted = settings_.prints_frames ? accepted_in_lines(output) : accepted_in_bytes(output);
    if (!accepted.empty()) return {std::move(accepted), {}};
    return {{},
            DecoderFault{DecoderFault::Kind::garbage,
                         "no message in its output, not even an undisturbed one: "
                         "does --decoder-output say what it prints?",
                         {}}};
  }

  static Decoded failed(DecoderFault fault) {
    refuse_missing(fault);
    return {{}, std::move(fault)};
  }

 private:
  const std::string command_;
  const ProgramSettings settings_;
  const LineCapture& format_;
};

class ProgramForEach : public ProgramDecoder {
 public:
  ProgramForEach(const std::string& command, const ProgramSettings& settings)
      : ProgramDecoder(command, settings),
        folder_(command.find(in_braces(format())) == std::string::npos
                    ? nullptr
                    : std::make_unique<CaptureFolder>()),
        warden_(folder_ ? folder_->path() : fs::path()) {}

  Decoded decode(const DelimitedStream& line) const override {
    const std::string bytes = format().bytes(line);
    if (!folder_) return answer(command(), bytes);
    const CaptureFile file(*folder_, format().ending, bytes);
    return answer(replaced(command(), in_braces(format()), shell_word(file.path().string())), "");
  }

 private:
  Decoded answer(const std::string& command, const std::string& input) const {
    ChildProcess child(command, &warden_);
    std::string output;
    const Waited waited = child.run({.input = input,
                                     .most_output = most_output,
                                     .timeout = settings().timeout,
                                     .stop = &heed_stop_signals()},
                                    output);
    if (waited == Waited::stopped) return {};
    if (waited == Waited::ended && child.status() == 0) return decoded(output);
    return failed(fault_of(waited, child, settings()));
  }

  const std::unique_ptr<CaptureFolder> folder_;  // where the command reads files
  const Warden warden_;
};

/// An answer so far: a first line that says how many bytes follow, and those that came.
class Answer {
 public:
  explicit Answer(const std::string& text) : text_(text), end_(text.find('\n')) {
    const double count = parse_number(text.substr(0, end_)).value_or(-1);
    if (count >= 0 && count == std::floor(count)) count_ = count;
  }

  /// Its first line is no number of bytes, or more came.
  bool is_garbage() const {
    constexpr std::size_t longest = 20;
    return is_begun() ? !count_ || came() > *count_ : text_.size() > longest;
  }
  bool is_whole() const { return is_begun() && count_ && came() == *count_; }
  std::string bytes() const { return text_.substr(end_ + 1); }

 private:
  bool is_begun() const { return end_ != std::string::npos; }
  double came() const { return static_cast<double>(text_.size() - end_ - 1); }

  const std::string& text_;
  std::size_t end_;
  std::optional<double> count_;
};

class ServingProgram : public ProgramDecoder {
 public:
  ServingProgram(const std::string& command, const ProgramSettings& settings)
      : ProgramDecoder(command, settings) {
    if (command.find(in_braces(format())) != std::string::npos)
      throw bad_input("--decoder " + command, "one that serves gets edges on its stdin",
                      "leave " + in_braces(format()) + " out");
  }

  ServingProgram(const ServingProgram&) = delete;
  ServingProgram& operator=(const ServingProgram&) = delete;
  /// Those that wait see the end of their stdin, and have a moment, all together, to end in order.
  ~ServingProgram() override {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + farewell;
    for (const auto& child : idle_) child->close_input();
    for (const auto& child : idle_) {
      std::string unread;
      child->run({.input = "",
                  .most_output = most_output,
                  .timeout = end - Clock::now(),
                  .stop = &heed_stop_signals()},
                 unread);
    }
  }

  Decoded decode(const DelimitedStream& line) const override {
    const std::string bytes = format().bytes(line);
    const std::string input = fmt::format("{}\n", bytes.size()) + bytes;
    auto child = take();
    std::string output;
    const Waited waited = child->run({.input = input,
                                      .close = false,
                                      .is_complete =
                                          [](const std::string& text) {
                                            const Answer answer(text);
                                            return answer.is_garbage() || answer.is_whole();
                                          },
                                      .most_output = most_output,
                                      .timeout = settings().timeout,
                                      .stop = &heed_stop_signals()},
                                     output);
    if (waited == Waited::stopped) return {};
    if (waited != Waited::done) return failed(fault_of(waited, *child, settings()));
    const Answer answer(output);
    if (!answer.is_whole())
      return failed({DecoderFault::Kind::garbage,
                     "its answer is not a number of bytes and so many bytes", child->words()});
    give_back(std::move(child));
    return decoded(answer.bytes());
  }

 private:
  /// One that waits for a capture.
  std::unique_ptr<ChildProcess> take() const {
    const std::scoped_lock lock(mutex_);
    if (idle_.empty()) return std::make_unique<ChildProcess>(command(), &warden_);
    auto child = std::move(idle_.back());
    idle_.pop_back();
    return child;
  }
  void give_back(std::unique_ptr<ChildProcess> child) const {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(child));
  }

  Warden warden_{{}};
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<ChildProcess>> idle_;
};

/// Whether a shell would find a program of that name.
bool is_program(const std::string& word) {
  if (word.find('/') != std::string::npos) return ::access(word.c_str(), X_OK) == 0;
  const char* folders = std::getenv("PATH");
  for (const std::string_view folder : split(folders == nullptr ? "" : folders, ':'))
    if (::access((fs::path(folder) / word).c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace

std::unique_ptr<Decoder> make_program_decoder(const std::string& command,
                                              const ProgramSettings& settings) {
  if (settings.serves) return std::make_unique<ServingProgram>(command, settings);
  return std::make_unique<ProgramForEach>(command, settings);
}

std::unique_ptr<Decoder> make_decoder(const std::string& name, const ProgramSettings& settings) {
  if (auto decoder = make_built_in_decoder(name)) return decoder;
  if (name.find_first_of(" \t{|<>;&") == std::string::npos && !is_program(name))
    throw bad_input("--decoder " + name, "no decoder of that name, and no program",
                    "did you mean " + nearest(name, built_in_decoders()) + "?");
  return make_program_decoder(name, settings);
}

}  // namespace sim
