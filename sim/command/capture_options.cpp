// Options of all commands that read captures: how a file is to be read, where it does not say so
// itself.
#include "sim/capture/capture_file.hpp"
#include "sim/capture/capture_units.hpp"
#include "sim/command/command_options.hpp"

namespace sim {
namespace {

CLI::Validator a_sample_rate() {
  return {[](const std::string& text) {
            return parse_sample_rate(text) ? std::string()
                                           : text + " is no rate from 1 to 1e12, such as 1MHz";
          },
          ""};
}

/// "us", "1us" or "10 ns".
std::optional<dsp::Seconds> tick_of(const std::string& text) {
  if (const auto unit = time_unit(text)) return unit;
  const auto tick = parse_interval(text, {});
  return tick && tick->value > 0 ? tick : std::nullopt;
}

CLI::Validator a_tick() {
  return {[](const std::string& text) {
            return tick_of(text) ? std::string() : text + " is no unit of time such as us or 10ns";
          },
          ""};
}

}  // namespace

void add_capture_options(CLI::App& app, CaptureOptions& options, const std::string& what_for) {
  app.add_option("--wire,--channel", options.wire,
                 "wire, channel or column " + what_for +
                     ", by name or by number from 1 on; if not given, by what is on them")
      ->type_name("NAME");
  app.add_option("--format", options.format, "of the capture, where its name does not say it")
      ->type_name("NAME")
      ->check(one_of(capture_format_names()));
  app.add_option_function<std::string>(
         "--sample-rate",
         [&options](const std::string& text) {
           options.sample_rate_hz = parse_sample_rate(text)->value;
         },
         "samples a second, such as 96000 or 1MHz, for a capture that does not say it")
      ->type_name("RATE")
      ->check(a_sample_rate());
  app.add_option_function<std::string>(
         "--time-unit", [&options](const std::string& text) { options.tick = tick_of(text); },
         "unit of time, such as us, 1us or 10ns, for a capture that does not say it")
      ->type_name("UNIT")
      ->check(a_tick());
  app.add_option("--skip-rows", options.skip_rows, "lines of a table to pass over first")
      ->type_name("N")
      ->check(CLI::Range(0, 1000000).description(""));
  app.add_option("--sample-bytes", options.sample_bytes,
                 "bytes a sample of a .bin, eight channels each; 1 if not given")
      ->type_name("N")
      ->check(CLI::Range(1, 8).description(""));
}

}  // namespace sim
