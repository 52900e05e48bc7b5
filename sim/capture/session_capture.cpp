#include "sim/capture/session_capture.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <utility>

#include "sim/capture/capture_units.hpp"
#include "sim/capture/key_file.hpp"
#include "sim/capture/raw_capture.hpp"
#include "sim/capture/sample_choice.hpp"
#include "sim/capture/text_lines.hpp"
#include "sim/failure.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_metadata = 65536, most_wires = 64;
static_assert(std::endian::native == std::endian::little, "samples are read as they are stored");

/// "12" of logic-1-12; nothing for other names.
std::optional<std::size_t> whole_behind(std::string_view prefix, std::string_view key) {
  if (!key.starts_with(prefix)) return std::nullopt;
  std::size_t number = 0;
  const std::string_view digits = key.substr(prefix.size());
  const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool whole = end.ec == std::errc() && end.ptr == digits.data() + digits.size();
  return whole ? std::optional(number) : std::nullopt;
}

/// Of a channel, such as probe3.
std::optional<std::size_t> number_behind(std::string_view prefix, std::string_view key) {
  const auto number = whole_behind(prefix, key);
  return number == 0U || number > 1000U ? std::nullopt : number;
}

/// The zip, read member by member in bounded memory.
class Archive {
 public:
  explicit Archive(const fs::path& path) : name_(path.string()) {
    zip_ = zip_open(path.c_str(), ZIP_RDONLY, nullptr);
    if (zip_ == nullptr) fail("no zip that can be read");
  }
  ~Archive() {
    if (member_ != nullptr) zip_fclose(member_);
    zip_discard(zip_);
  }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  bool open(const std::string& member) {
    if (member_ != nullptr) zip_fclose(std::exchange(member_, nullptr));
    if (zip_name_locate(zip_, member.c_str(), 0) < 0) return false;
    member_ = zip_fopen(zip_, member.c_str(), 0);
    if (member_ == nullptr) fail("its member " + member + " cannot be read");
    return true;
  }

  /// Of all members that are called so with a number behind.
  std::set<std::size_t> numbers_of(const std::string& name) const {
    std::set<std::size_t> numbers;
    for (zip_int64_t i = 0; i < zip_get_num_entries(zip_, 0); ++i)
      if (const char* member = zip_get_name(zip_, static_cast<zip_uint64_t>(i), 0))
        if (const auto number = whole_behind(name + "-", member)) numbers.insert(*number);
    return numbers;
  }

  /// Bytes of the open member; 0 at its end.
  std::size_t read(void* to, std::size_t size) {
    const zip_int64_t n = zip_fread(member_, to, size);
    if (n < 0) fail("a member is damaged");
    return static_cast<std::size_t>(n);
  }

  [[noreturn]] void fail(const std::string& why, const std::string& suggestion =
                                                     "give a session as sigrok or PulseView "
                                                     "save it") const {
    throw bad_input("cannot read " + name_, why, suggestion);
  }

 private:
  std::string name_;
  zip_t* zip_ = nullptr;
  zip_file_t* member_ = nullptr;
};

/// One stream of bytes out of all chunks: NAME-1, NAME-2, ..., or NAME alone.
class Chunks {
 public:
  Chunks(std::shared_ptr<Archive> archive, std::string name)
      : archive_(std::move(archive)), name_(std::move(name)) {
    const std::set<std::size_t> numbers = archive_->numbers_of(name_);
    open_ = archive_->open(name_);
    if (open_ && !numbers.empty())
      archive_->fail(fmt::format("it has both {0} and {0}-{1}", shown(name_), *numbers.begin()));
    for (std::size_t wanted = 1; const std::size_t number : numbers)
      if (number != wanted++)
        archive_->fail(fmt::format("its members {0}-1, {0}-2, ... have {1} where {2} must be",
                                   shown(name_), number, wanted - 1));
    open_ = open_ || archive_->open(name_ + "-1");
    if (!open_) archive_->fail("it has no member " + shown(name_));
  }

  std::size_t read(void* to, std::size_t size) {
    while (open_) {
      if (const std::size_t n = archive_->read(to, size)) return n;
      open_ = archive_->open(fmt::format("{}-{}", name_, ++chunk_));
    }
    return 0;
  }

 private:
  std::shared_ptr<Archive> archive_;
  std::string name_;
  std::size_t chunk_ = 1;
  bool open_ = false;
};

struct Metadata {
  std::string logic_name = "logic-1";
  std::size_t unit_bytes = 1;
  std::optional<dsp::Hertz> sample_rate;
  std::vector<std::string> wires;
  std::map<std::size_t, std::string> analogue;  // names by channel numbers
};

void refuse_other_version(Archive& archive) {
  char version = '2';
  if (archive.open("version")) archive.read(&version, 1);
  if (version != '1' && version != '2') archive.fail("its version is neither 1 nor 2");
}

std::string read_metadata(Archive& archive) {
  if (!archive.open("metadata")) archive.fail("it has no member metadata");
  std::string text(longest_metadata + 1, '\0');
  std::size_t size = 0;
  while (const std::size_t n = archive.read(text.data() + size, text.size() - size)) size += n;
  if (size > longest_metadata) archive.fail("its metadata are over 64 KiB");
  return text.substr(0, size);
}

/// The first device that has logic samples, else the first.
KeyGroup device_of(const Archive& archive, const std::string& metadata) {
  std::vector<KeyGroup> groups = read_key_file(metadata);
  std::erase_if(groups, [](const KeyGroup& group) { return !group.name.starts_with("device "); });
  if (groups.empty()) archive.fail("its metadata have no device");
  const auto with_logic = std::ranges::find_if(
      groups, [](const KeyGroup& group) { return !group.value("capturefile").empty(); });
  return with_logic == groups.end() ? groups.front() : *with_logic;
}

/// Channels without a name are not used.
std::vector<std::string> wires_of(const Archive& archive, const KeyGroup& device) {
  std::vector<std::string> wires;
  for (const auto& [key, value] : device.entries) {
    const auto probe = number_behind("probe", key);
    if (!probe || value.empty()) continue;
    if (*probe > most_wires) archive.fail("it has more than 64 logic channels");
    if (*probe > wires.size()) wires.resize(*probe);
    wires[*probe - 1] = value;
  }
  return wires;
}

/// Where the metadata do not say it, sessions have room for all channels, used or not.
std::size_t unit_bytes_of(const Archive& archive, const KeyGroup& device, std::size_t wires) {
  const std::size_t channels = number_behind("", device.value("total probes")).value_or(0);
  const std::string said = device.value("unitsize");
  if (said.empty()) return (std::max({wires, channels, std::size_t{1}}) + 7) / 8;
  const std::size_t bytes = number_behind("", said).value_or(0);
  if (bytes == 0 || bytes < (wires + 7) / 8) archive.fail("its unitsize does not fit its channels");
  return bytes;
}

Metadata parse(const Archive& archive, const KeyGroup& device) {
  Metadata metadata;
  if (const std::string name = device.value("capturefile"); !name.empty())
    metadata.logic_name = name;
  metadata.sample_rate = parse_sample_rate(device.value("samplerate"));
  metadata.wires = wires_of(archive, device);
  metadata.unit_bytes = unit_bytes_of(archive, device, metadata.wires.size());
  for (const auto& [key, value] : device.entries)
    if (const auto number = number_behind("analog", key); number && !value.empty())
      metadata.analogue[*number] = value;
  return metadata;
}

class SessionSamples : public SampleCapture {
 public:
  SessionSamples(std::shared_ptr<Archive> archive, const std::string& name, dsp::Hertz rate)
      : archive_(archive), chunks_(std::move(archive), name), rate_(rate) {}

  dsp::Hertz sample_rate() const override { return rate_; }
  bool is_complex() const override { return false; }

  std::size_t read(std::span<std::complex<float>> to) override {
    std::size_t count = 0;
    for (float sample = 0; count < to.size() && read_float(sample); ++count) {
      if (!std::isfinite(sample)) archive_->fail("a sample is not finite");
      to[count] = sample;
    }
    return count;
  }

 private:
  bool read_float(float& sample) {
    while (bytes_ - next_ < sizeof(float)) {
      std::memmove(buffer_.data(), buffer_.data() + next_, bytes_ - next_);
      bytes_ -= std::exchange(next_, 0);
      const std::size_t n = chunks_.read(buffer_.data() + bytes_, buffer_.size() - bytes_);
      if (n == 0) return false;
      bytes_ += n;
    }
    std::memcpy(&sample, buffer_.data() + next_, sizeof(float));
    next_ += sizeof(float);
    return true;
  }

  std::shared_ptr<Archive> archive_;
  Chunks chunks_;
  dsp::Hertz rate_;
  std::array<char, 65536> buffer_{};
  std::size_t bytes_ = 0, next_ = 0;
};

std::unique_ptr<LogicCapture> open_logic(const std::shared_ptr<Archive>& archive,
                                         const Metadata& metadata) {
  const auto chunks = std::make_shared<Chunks>(archive, metadata.logic_name);
  const auto block = std::make_shared<std::array<std::uint8_t, 65536>>();
  const auto blocks = [chunks, block]() -> std::span<const std::uint8_t> {
    return std::span(*block).first(chunks->read(block->data(), block->size()));
  };
  return std::make_unique<LogicSamples>(metadata.wires, metadata.unit_bytes, *metadata.sample_rate,
                                        blocks);
}

/// Whether an analogue channel is read: one that was asked for, or where no wire moves.
bool wants_analogue(const std::shared_ptr<Archive>& archive, const Metadata& metadata,
                    const std::string& wanted) {
  if (metadata.wires.empty()) return true;
  if (!wanted.empty())
    return std::ranges::any_of(metadata.analogue,
                               [&](const auto& channel) { return channel.second == wanted; });
  const auto edges = SurveyedCapture(open_logic(archive, metadata)).edges();
  return std::ranges::none_of(edges, [](std::uint64_t count) { return count > 0; });
}

void take_analogue(const fs::path& path, const Metadata& metadata, const CaptureSettings& settings,
                   Capture& capture) {
  SampleChannels channels;
  std::vector<std::size_t> numbers;
  for (const auto& [number, name] : metadata.analogue) {
    numbers.push_back(number);
    channels.names.push_back(name);
  }
  channels.open = [&](std::size_t channel) {
    return std::make_unique<SessionSamples>(std::make_shared<Archive>(path),
                                            fmt::format("analog-1-{}", numbers[channel]),
                                            *metadata.sample_rate);
  };
  take_samples(path.string(), channels, settings, capture);
}

}  // namespace

void open_session(const fs::path& path, const CaptureSettings& settings, Capture& capture) {
  const auto archive = std::make_shared<Archive>(path);
  refuse_other_version(*archive);
  Metadata metadata = parse(*archive, device_of(*archive, read_metadata(*archive)));
  metadata.sample_rate = settings.rate_over(metadata.sample_rate);
  if (!metadata.sample_rate)
    archive->fail("its metadata have no samplerate of 1 Hz to 1 THz", "say --sample-rate");
  if (!metadata.analogue.empty() && wants_analogue(archive, metadata, settings.wire))
    take_analogue(path, metadata, settings, capture);
  else
    capture.logic = open_logic(archive, metadata);
  if (capture.logic && settings.wire.empty() && !metadata.analogue.empty())
    capture.facts.assumed.push_back(
        fmt::format("no line on its analogue channels ({})", metadata.analogue.size()));
  capture.facts.time = samples_text(*metadata.sample_rate);
}

}  // namespace sim
