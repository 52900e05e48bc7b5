#include "sim/page/eye_diagram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/picture/svg.hpp"
#include "sim/picture/waveform.hpp"
#include "sim/trace/traced_message.hpp"

namespace sim {
namespace {

constexpr const char* caption =
    "The integrator over two bits, all bits of the message over each other";

// Pixels.
constexpr double eye_width = 720, eye_height = 336, eye_left = 80, eye_right = 700, eye_top = 50,
                 eye_bottom = 260;

/// In samples, from where the pin reports light.
double upper_stop(const ShownTrial& shown) {
  return shown.module.integrator_cycles * shown.trial.sample_rate.value / shown.module.centre_hz;
}

/// Enough of them to show a bit: the integrator is much slower than the samples.
std::vector<float> thinned(const std::vector<float>& samples, std::size_t step) {
  std::vector<float> kept;
  for (std::size_t i = 0; i < samples.size(); i += step) kept.push_back(samples[i]);
  return kept;
}

void draw_axes(SvgDrawing& drawing, const Scale& level) {
  drawing.text({20, 20}, "Eye diagram of the integrator", "heading");
  for (const double bits : {0.0, 0.5, 1.0, 1.5, 2.0}) {
    const double x = eye_left + (eye_right - eye_left) * bits / 2;
    drawing.line({x, eye_top}, {x, eye_bottom}, "grid");
    drawing.text({x, eye_bottom + 18}, fmt::format("{:g}", bits), "middle small");
  }
  for (const double samples : {level.from, level.to})
    drawing.text({eye_left - 8, level(samples) + 4}, fmt::format("{:.3g}", samples), "end small");
  drawing.text({20, eye_top - 12}, "integrator [samples]", "");
  drawing.text({(eye_left + eye_right) / 2, eye_bottom + 42}, "bits since the sender's bit began",
               "middle");
}

/// Where the pin switches, and where it is read.
void draw_decision(SvgDrawing& drawing, const Scale& level, double stop) {
  const double read = eye_left + (eye_right - eye_left) / 4;
  for (const double at : {stop, 0.0})
    drawing.line({eye_left, level(at)}, {eye_right, level(at)}, "level");
  drawing.text({eye_right - 4, level(stop) - 4}, "reached: the pin turns light", "end small");
  drawing.text({eye_right - 4, level(0) - 4}, "reached: the pin turns dark", "end small");
  drawing.line({read, eye_top}, {read, eye_bottom}, "level");
  drawing.text({read + 4, eye_top - 4}, "the bit is read", "small");
}

struct EyeTraces {
  std::vector<std::string> right, misread;  // paths
};

EyeTraces traces_of(const TracedTrial& trial, const Scale& level) {
  constexpr double steps_a_bit = 64;
  const TracedMessage message = message_of(trial);
  const double bit_s = message.character_s / protocol::bits_per_byte;
  const auto step =
      static_cast<std::size_t>(std::max(1.0, bit_s * trial.sample_rate.value / steps_a_bit));
  const std::vector<float> integrator = thinned(trial.taps.integrator, step);
  const double sample_s = 1 / trial.sample_rate.value;
  EyeTraces traces;
  for (std::size_t i = 0; i < message.sent.size(); ++i)
    for (int slot = 0; slot < protocol::bits_per_byte; ++slot) {
      const double from_s = message.start_s(i) + slot * bit_s;
      (is_wrong_at_pin(trial, message, i, slot) ? traces.misread : traces.right)
          .push_back(sampled_path({integrator, sample_s, sample_s * static_cast<double>(step)},
                                  {from_s, from_s + 2 * bit_s, eye_left, eye_right}, level));
    }
  return traces;
}

}  // namespace

std::string eye_as_svg(const ShownTrial& shown) {
  const double stop = upper_stop(shown);
  const Scale level{0, std::max({1.0, stop, double{std::ranges::max(shown.trial.taps.integrator)}}),
                    eye_bottom, eye_top};
  SvgDrawing drawing(eye_width, eye_height, "Eye diagram", caption);
  draw_axes(drawing, level);
  const EyeTraces traces = traces_of(shown.trial, level);
  for (const std::string& path : traces.right) drawing.path(path, "eye");
  draw_decision(drawing, level, stop);
  for (const std::string& path : traces.misread) drawing.path(path, "misread");
  if (traces.misread.empty()) return drawing.finished();
  drawing.line({eye_left, eye_height - 14}, {eye_left + 25, eye_height - 14}, "misread");
  drawing.text({eye_left + 32, eye_height - 10},
               fmt::format("misread at the pin: {} of {} bits", traces.misread.size(),
                           traces.misread.size() + traces.right.size()),
               "");
  return drawing.finished();
}

PagePicture eye_picture(const ShownTrial& shown) {
  return {"eye",
          fmt::format("{}. It goes up by one in a sample of light and down by one in a dark one, "
                      "from 0 to {:.3g}, which are {:g} cycles of {:g} kHz; the pin switches at "
                      "these two",
                      caption, upper_stop(shown), shown.module.integrator_cycles,
                      shown.module.centre_hz / 1e3),
          eye_as_svg(shown)};
}

}  // namespace sim
