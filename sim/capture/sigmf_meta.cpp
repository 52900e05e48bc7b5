#include "sim/capture/sigmf_meta.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "sim/capture/sample_capture.hpp"
#include "sim/capture/text_lines.hpp"
#include "sim/capture/text_mark.hpp"
#include "sim/text/number_text.hpp"
#include "sim/text/text_file.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t longest_meta = 64 * mebibyte, most_channels = 64;

template <class Number>
double number_in(const unsigned char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof(number));
  return static_cast<double>(number);
}

/// What "core:datatype" names behind its r or c. The standard does not say what stands for 0 in the
/// unsigned types; that it is the middle, 2^(bits - 1), is what its own library takes them for
/// (sigmf/sigmf-python 1.2, SigMFFile with autoscale), and what RTL-SDRs mean within half a step.
const std::map<std::string, SigmfNumber, std::less<>> number_types = {
    {"f32", {4, number_in<float>, 0}},
    {"f64", {8, number_in<double>, 0}},
    {"i32", {4, number_in<std::int32_t>, 0}},
    {"i16", {2, number_in<std::int16_t>, 0}},
    {"u32", {4, number_in<std::uint32_t>, 0x1p31}},
    {"u16", {2, number_in<std::uint16_t>, 0x1p15}},
    {"i8", {1, number_in<std::int8_t>, 0}},
    {"u8", {1, number_in<std::uint8_t>, 0x1p7}}};

// Fields of SigMF 0.0.1 to 1.2 that are read, or do not change how samples are read. The last ones
// are no fields of these objects, but programs write them there, and they say what others do.
constexpr std::string_view global_fields[] = {
    "datatype",      "sample_rate",    "version",     "num_channels", "offset",    "dataset",
    "metadata_only", "trailing_bytes", "extensions",  "sha512",       "author",    "collection",
    "data_doi",      "meta_doi",       "description", "hw",           "license",   "recorder",
    "geolocation",   "datetime",       "frequency",   "comment",      "generator", "label"};
constexpr std::string_view capture_fields[] = {
    "sample_start", "header_bytes", "global_index", "frequency", "datetime", "geolocation",
    "sample_count", "length",       "comment",      "generator", "label",    "description"};

constexpr const char* cut_it = "make a recording of each of its captures";

/// One metadata file, and what is wrong with it.
/// Digits alone, as a number.
std::optional<unsigned> digits(std::string_view text) {
  unsigned number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Seconds since 1970, of "2026-11-25T16:21:05.5Z" (RFC 3339); nothing of other texts.
std::optional<double> seconds_of_date(const std::string& text) {
  constexpr std::string_view form = "0000-00-00T00:00:00";
  if (text.size() <= form.size() || text.back() != 'Z') return std::nullopt;
  for (std::size_t i = 0; i < form.size(); ++i)
    if (form[i] != '0' && text[i] != form[i]) return std::nullopt;
  const std::string_view date = text;
  const auto year = digits(date.substr(0, 4)), month = digits(date.substr(5, 2)),
             day = digits(date.substr(8, 2)), hour = digits(date.substr(11, 2)),
             minute = digits(date.substr(14, 2));
  const auto second = parse_number(date.substr(17, text.size() - 18));
  if (!year || !month || !day || !hour || !minute || !second || !std::isfinite(*second))
    return std::nullopt;
  const std::chrono::year_month_day found{std::chrono::year(static_cast<int>(*year)),
                                          std::chrono::month(*month), std::chrono::day(*day)};
  if (!found.ok()) return std::nullopt;
  const auto days = static_cast<double>(std::chrono::sys_days(found).time_since_epoch().count());
  return ((days * 24 + *hour) * 60 + *minute) * 60 + *second;
}

class SigmfMeta {
 public:
  explicit SigmfMeta(const fs::path& file) : file_(file) {
    const std::string text = read_text_file(file, "SigMF metadata", longest_meta);
    try {
      json_ = Json::parse(std::string_view(text).substr(mark_bytes(text, file.string())));
    } catch (const Json::parse_error& error) {
      throw unreadable_recording(file, fmt::format("no JSON from byte {} on", error.byte));
    } catch (const Json::out_of_range&) {
      throw unreadable_recording(file, "it has a number that no computer has room for");
    }
    if (!global().is_object()) fail("it has no object global");
    if (!captures().is_array()) fail("its captures are no list");
  }

  SigmfLayout layout(const CaptureSettings& settings) const {
    refuse_other_fields(global(), global_fields);
    refuse_other_version();
    refuse_extensions();
    SigmfLayout layout;
    set_type(layout);
    layout.sample_rate = sample_rate(settings);
    layout.channels = count(global(), "core:num_channels").value_or(1);
    layout.trailing_bytes = count(global(), "core:trailing_bytes").value_or(0);
    layout.data = data_file();
    layout.segments = segments();
    refuse_gaps(layout.sample_rate);
    if (layout.is_complex) refuse_moves();
    if (layout.channels < 1 || layout.channels > most_channels)
      fail("core:num_channels is not from 1 to 64");
    return layout;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const { throw unreadable_recording(file_, why); }

  const Json& global() const { return member(json_, "global"); }
  const Json& captures() const {
    static const Json none = Json::array();
    const Json& list = member(json_, "captures");
    return list.is_null() ? none : list;
  }

  /// Null if it is not there.
  static const Json& member(const Json& object, const char* key) {
    static const Json null;
    const auto found = object.is_object() ? object.find(key) : object.end();
    return found == object.end() ? null : *found;
  }

  std::optional<std::uint64_t> count(const Json& object, const char* key) const {
    const Json& value = member(object, key);
    if (value.is_null()) return std::nullopt;
    if (value.is_number_unsigned()) return value.get<std::uint64_t>();
    const double number = value.is_number_float() ? value.get<double>() : -1;  // as of 5e3
    if (number < 0 || number > 0x1p53 || number != std::floor(number))
      fail(fmt::format("{} is no count", key));
    return static_cast<std::uint64_t>(number);
  }

  std::optional<double> number(const Json& object, const char* key) const {
    const Json& value = member(object, key);
    if (value.is_null()) return std::nullopt;
    if (!value.is_number()) fail(fmt::format("{} is no number", key));
    return value.get<double>();
  }

  std::string text(const Json& object, const char* key) const {
    const Json& value = member(object, key);
    if (value.is_null()) return "";
    if (!value.is_string()) fail(fmt::format("{} is no text", key));
    return value.get<std::string>();
  }

  void refuse_other_fields(const Json& object, std::span<const std::string_view> known) const {
    constexpr std::string_view core = "core:";
    if (!object.is_object()) fail("a capture is no object");
    for (const auto& [key, value] : object.items())
      if (key.starts_with(core) && std::ranges::count(known, key.substr(core.size())) == 0)
        fail("its " + shown(key) + " is not known here, and may say how samples are to be read");
  }

  void refuse_other_version() const {
    const std::string version = text(global(), "core:version");
    const std::string_view number = std::string_view(version).substr(version.starts_with('v'));
    if (!number.empty() && !number.starts_with("0.") && !number.starts_with("1."))
      fail("its core:version is " + shown(version));
  }

  void refuse_extensions() const {
    const Json& extensions = member(global(), "core:extensions");
    if (!extensions.is_array()) return;  // before 1.0 an object, of names and versions
    for (const Json& extension : extensions) {
      const Json& optional = member(extension, "optional");
      if (!optional.is_boolean() || !optional.get<bool>())
        fail("its extension '" + shown(text(extension, "name")) +
             "' in core:extensions is not optional, and not known here");
    }
  }

  void set_type(SigmfLayout& layout) const {
    const std::string type = text(global(), "core:datatype");
    const bool big = type.ends_with("_be");
    const bool ordered = big || type.ends_with("_le");
    const std::string name = type.substr(0, type.size() - (ordered ? 3 : 0));
    const auto found = number_types.find(std::string_view(name).substr(name.empty() ? 0 : 1));
    if (found == number_types.end() || (name[0] != 'c' && name[0] != 'r'))
      fail("core:datatype '" + shown(type) + "' is not one of SigMF");
    layout.is_complex = name[0] == 'c';
    layout.number = found->second;
    layout.swapped = big != (std::endian::native == std::endian::big);
  }

  dsp::Hertz sample_rate(const CaptureSettings& settings) const {
    const auto number_there = number(global(), "core:sample_rate");
    const bool is_known = number_there && is_sample_rate(dsp::Hertz(*number_there));
    const auto rate =
        settings.rate_over(is_known ? std::optional(dsp::Hertz(*number_there)) : std::nullopt);
    if (rate) return *rate;
    throw unreadable_recording(
        file_,
        number_there ? "core:sample_rate is not from 1 Hz to 1 THz" : "it has no core:sample_rate",
        "say --sample-rate");
  }

  fs::path data_file() const {
    const Json& only = member(global(), "core:metadata_only");
    if (only.is_boolean() && only.get<bool>())
      throw unreadable_recording(file_, "core:metadata_only says that its samples are not there",
                                 "give it with its samples");
    const std::string name = text(global(), "core:dataset");
    if (name.find_first_of("/\\") != std::string::npos || name == "." || name == "..")
      fail("core:dataset is not the name of a file beside it");
    return name.empty() ? sigmf_beside(file_, ".sigmf-data") : file_.parent_path() / name;
  }

  std::uint64_t start_of(const Json& capture) const {
    const auto start = count(capture, "core:sample_start");
    if (!start) fail("a capture has no core:sample_start");
    return *start;
  }

  std::vector<SigmfSegment> segments() const {
    const std::uint64_t offset = count(global(), "core:offset").value_or(0);
    std::vector<SigmfSegment> segments;
    for (const Json& capture : captures()) {
      refuse_other_fields(capture, capture_fields);
      const std::uint64_t start = start_of(capture);
      if (start < offset) fail("a core:sample_start is before core:offset");
      if (!segments.empty() && start - offset < segments.back().first_sample)
        fail("its captures are not in the order of core:sample_start");
      segments.push_back({start - offset, count(capture, "core:header_bytes").value_or(0)});
    }
    return segments;
  }

  /// By core:global_index, which counts samples that were lost too, and by the time of day.
  void refuse_gaps(dsp::Hertz rate) const {
    for (std::size_t i = 1; i < captures().size(); ++i) {
      const Json &before = captures()[i - 1], &capture = captures()[i];
      const std::uint64_t start = start_of(before), next = start_of(capture);
      const auto index = count(before, "core:global_index").value_or(start);
      if (count(capture, "core:global_index").value_or(next) - index != next - start)
        throw unreadable_recording(
            file_, fmt::format("core:global_index says that samples before {} are missing", next),
            cut_it);
      const auto time = time_of(before), then = time_of(capture);
      const double lasts = static_cast<double>(next - start) / rate.value;
      if (time && then && std::abs(*then - *time - lasts) > clock_error)
        throw unreadable_recording(
            file_, fmt::format("core:datetime says that time before sample {} is missing", next),
            cut_it);
    }
  }

  std::optional<double> time_of(const Json& capture) const {
    return seconds_of_date(text(capture, "core:datetime"));
  }

  void refuse_moves() const {
    std::optional<double> middle;
    for (const Json& capture : captures()) {
      const auto frequency = number(capture, "core:frequency");
      if (frequency && middle && *frequency != *middle)
        throw unreadable_recording(
            file_, fmt::format("its core:frequency changes at sample {}", start_of(capture)),
            cut_it);
      if (frequency) middle = frequency;
    }
  }

  static constexpr double clock_error = 2;  // s, assumed: some programs write whole seconds

  fs::path file_;
  Json json_;
};

}  // namespace

Failure unreadable_recording(const fs::path& meta, const std::string& why,
                             const std::string& suggestion) {
  return bad_input("cannot read " + meta.string(), why, suggestion);
}

fs::path sigmf_beside(const fs::path& file, std::string ending) {
  const std::string own = file.extension().string();
  const auto is_small = [](char c) { return c >= 'a' && c <= 'z'; };
  if (!own.empty() && std::ranges::none_of(own, is_small))
    std::ranges::transform(ending, ending.begin(), [&](char c) {
      return is_small(c) ? static_cast<char>(c - ('a' - 'A')) : c;
    });
  return fs::path(file).replace_extension(ending);
}

SigmfLayout read_sigmf_meta(const fs::path& meta, const CaptureSettings& settings) {
  return SigmfMeta(meta).layout(settings);
}

}  // namespace sim
