#include "sim/picture/waveform.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sim {
namespace {

constexpr double samples_a_column = 3;  // with fewer a line from sample to sample says more

struct SampleRange {
  std::size_t first = 0, end = 0;
};

/// The samples within [from_s, to_s).
SampleRange samples_within(const SampledWave& wave, double from_s, double to_s) {
  const auto at = [&](double time_s) {
    const double index = std::ceil((time_s - wave.first_s) / wave.period_s);
    return static_cast<std::size_t>(
        std::clamp(index, 0.0, static_cast<double>(wave.samples.size())));
  };
  return {at(from_s), at(to_s)};
}

std::string by_sample(const SampledWave& wave, SampleRange range, const Scale& x, const Scale& y) {
  std::string path;
  for (std::size_t i = range.first; i < range.end; ++i)
    path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? 'M' : 'L',
                        x(wave.first_s + static_cast<double>(i) * wave.period_s),
                        y(double{wave.samples[i]}));
  return path;
}

std::string by_column(const SampledWave& wave, const Scale& x, const Scale& y) {
  std::string path;
  for (double column = std::floor(x.at_from); column < x.at_to; ++column) {
    const SampleRange range = samples_within(wave, std::max(x.from, x.value_at(column)),
                                             std::min(x.to, x.value_at(column + 1)));
    if (range.first >= range.end) continue;
    const auto [least, greatest] =
        std::ranges::minmax(wave.samples.subspan(range.first, range.end - range.first));
    path += fmt::format("{}{:.1f} {:.2f}V{:.2f}", path.empty() ? 'M' : 'L', column + 0.5,
                        y(double{least}), y(double{greatest}));
  }
  return path;
}

}  // namespace

std::string wire_path(const dsp::LogicTrace& wire, const Scale& x, const Scale& y) {
  const auto edges = wire.edges();
  bool level = wire.level_at(dsp::Seconds(x.from));
  std::string path = fmt::format("M{:.2f} {:.2f}", x(x.from), y(level ? 1 : 0));
  const auto first = std::ranges::upper_bound(edges, dsp::Seconds(x.from));
  for (auto edge = first; edge != edges.end() && edge->value < x.to; ++edge) {
    level = !level;
    path += fmt::format("H{:.2f}V{:.2f}", x(edge->value), y(level ? 1 : 0));
  }
  return path + fmt::format("H{:.2f}", x(std::min(x.to, std::max(x.from, wire.end().value))));
}

std::string sampled_path(const SampledWave& wave, const Scale& x, const Scale& y) {
  const SampleRange range = samples_within(wave, x.from, x.to);
  const double columns = x.at_to - x.at_from;
  return static_cast<double>(range.end - range.first) < samples_a_column * columns
             ? by_sample(wave, range, x, y)
             : by_column(wave, x, y);
}

}  // namespace sim
