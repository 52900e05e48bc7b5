#include "sim/location/presence_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "channel/bursts.hpp"
#include "protocol/cosys.hpp"
#include "protocol/short_pulses.hpp"
#include "sim/failure.hpp"
#include "sim/noise/addressed_normals.hpp"

namespace sim {
namespace {

double mean(const std::vector<double>& samples) {
  if (samples.empty()) return 0;
  return std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
}

std::vector<channel::Burst> message_bursts(const KeyedMessage& keyed, double sample_rate_hz) {
  dsp::LogicTrace line;
  dsp::Seconds at(0);
  for (const std::uint8_t byte : protocol::cosys_encode(keyed.message))
    at = protocol::send_byte_in_pulses(line, byte, at, keyed.baud, keyed.pulse);
  return channel::bursts_of(line, dsp::Hertz(sample_rate_hz));
}

std::size_t clipped_samples(const channel::LightMeter& meter, const std::vector<double>& volts) {
  const auto clipped = [&](double v) { return channel::is_clipped(meter, v); };
  return static_cast<std::size_t>(std::ranges::count_if(volts, clipped));
}

}  // namespace

PresencePoint::PresencePoint(const PresenceSettings& settings)
    : s_(settings),
      goertzel_(settings.tuned_to.value / settings.meter.sample_rate_hz, settings.window_samples),
      dark_volts_(channel::noiseless_volts(s_.meter, s_.light, {.samples = 1}).front()),
      deviation_(deviation_at(dark_volts_)) {
  if (s_.keyed) place_message();
  refuse_blindness();
}

PresencePoint::Trial PresencePoint::trial(std::uint32_t number) const {
  const dsp::RandomAddress place = address(number, Purpose::meter_window);
  const channel::MeterWindow window = window_at(place.uniform(0), place.uniform(1));
  const auto normals = addressed_normals(address(number, Purpose::meter_noise), samples_drawn());
  const std::size_t n = s_.window_samples;
  const Samples dark = sampled(Samples(n, dark_volts_), normals.data());
  const Samples lit =
      sampled(channel::noiseless_volts(s_.meter, s_.light, window), normals.data() + n);
  const Samples reference = sampled(dark_reference(), normals.data() + 2 * n);
  std::size_t clipped = 0;
  for (const Samples* each : {&dark, &lit, &reference}) clipped += clipped_samples(s_.meter, *each);
  const Statistic statistic = statistic_at(window.phase);
  return {statistic(dark, reference), statistic(lit, reference), clipped};
}

DetectionLaw PresencePoint::law(double phase, double place) const {
  const Samples lit = channel::noiseless_volts(s_.meter, s_.light, window_at(phase, place));
  return {statistic_at(phase)(lit, dark_reference()),
          statistic_widening(deviation_at(mean(lit)) / deviation_)};
}

double PresencePoint::in_ms(double samples) const {
  return samples / s_.meter.sample_rate_hz * 1e3;
}

dsp::RandomAddress PresencePoint::address(std::uint32_t trial, Purpose purpose) const {
  return {s_.seed, s_.point, trial, static_cast<std::uint32_t>(purpose)};
}

double PresencePoint::deviation_at(double mean_volts) const {
  return std::hypot(channel::noise_volts(s_.meter, mean_volts),
                    channel::adc_step(s_.meter) / std::sqrt(12));
}

void PresencePoint::place_message() {
  message_ = message_bursts(*s_.keyed, s_.meter.sample_rate_hz);
  room_ = message_.back().off - static_cast<double>(s_.window_samples);
  if (room_ < 0)
    throw bad_input(
        fmt::format("presence.window_ms = {:g}", in_ms(static_cast<double>(s_.window_samples))),
        fmt::format("the message's light ends after {:.4g} ms", in_ms(message_.back().off)),
        "take a shorter window or a longer device.message");
}

void PresencePoint::refuse_blindness() const {
  const bool blind = (s_.detector == Detector::synchronous && synchronous(0).blind()) ||
                     (s_.detector == Detector::goertzel && goertzel_.blind());
  if (blind)
    throw bad_input(fmt::format("presence.tuned_hz = {:g} with presence.adc_rate_hz = {:g}",
                                s_.tuned_to.value, s_.meter.sample_rate_hz),
                    "to it the carrier looks like steady light", "take another sample rate");
}

channel::MeterWindow PresencePoint::window_at(double phase, double place) const {
  channel::MeterWindow window = channel::steady_window(s_.window_samples, phase);
  if (!s_.keyed) return window;
  const double begin = place * room_;
  window.bursts = message_;
  for (channel::Burst& burst : window.bursts) burst = {burst.on - begin, burst.off - begin};
  return window;
}

channel::SynchronousDetector PresencePoint::synchronous(double phase) const {
  channel::MeteredLight wanted = s_.light;
  wanted.signal = dsp::WattsPerSquareMetre(1);
  wanted.ambient = dsp::WattsPerSquareMetre(0);
  wanted.carrier = s_.tuned_to;
  channel::LightMeter meter = s_.meter;
  meter.photodiode.dark_current_na = 0;
  return channel::SynchronousDetector(
      channel::noiseless_volts(meter, wanted, channel::steady_window(s_.window_samples, phase)));
}

PresencePoint::Statistic PresencePoint::statistic_at(double phase) const {
  if (s_.detector == Detector::synchronous)
    return [replica = synchronous(phase), this](const Samples& window, const Samples&) {
      return replica.blind() ? 0 : replica(window) / deviation_;
    };
  if (s_.detector == Detector::goertzel)
    return [this](const Samples& window, const Samples&) {
      return goertzel_(window) / (deviation_ * deviation_);
    };
  return [this](const Samples& window, const Samples& reference) {
    return channel::dc_difference(window, reference) / deviation_;
  };
}

/// From the deviation of a sample to that of the statistic: the reference has no light.
double PresencePoint::statistic_widening(double widening) const {
  if (s_.detector != Detector::dc_difference) return widening;
  const double window = 1 / static_cast<double>(s_.window_samples);
  const double reference = 1 / static_cast<double>(s_.reference_samples);
  return std::sqrt((widening * widening * window + reference) / (window + reference));
}

PresencePoint::Samples PresencePoint::dark_reference() const {
  return Samples(references_drawn(), dark_volts_);
}

PresencePoint::Samples PresencePoint::sampled(Samples volts, const float* normals) const {
  const double deviation = channel::noise_volts(s_.meter, mean(volts));
  for (std::size_t i = 0; i < volts.size(); ++i)
    volts[i] = channel::converted(s_.meter, volts[i] + deviation * static_cast<double>(normals[i]));
  return volts;
}

}  // namespace sim
