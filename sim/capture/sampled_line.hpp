#pragma once
// SampledLine: the UART line in a capture of samples. Of light it is the envelope of the carrier,
// light being 0; of a wire's voltage the voltage itself. Edges are where it passes the middle
// between its two levels, interpolated between samples; they count once it has gone a tenth of the
// way on to the other level.
//
// The carrier and the two levels are found in the first samples that are no silence: in which there
// is a carrier, or two levels that are well apart. Two million silent ones at a time are passed
// over: the line is taken to stand still in them. Later each level follows the mean of what is read
// as it, with a time constant of 0.1 s, so light may slowly become brighter or darker.
#include <deque>
#include <optional>
#include <vector>

#include "sim/capture/envelope_detector.hpp"
#include "sim/capture/logic_capture.hpp"
#include "sim/capture/sample_capture.hpp"

namespace sim {

/// Of real samples the frequency, of a baseband its distance from the middle; 0: a voltage, or the
/// middle of a baseband. Nothing: found in the samples; of a baseband 0.
struct LineKeying {
  std::optional<dsp::Hertz> carrier;
  std::optional<dsp::Hertz> baud;  // nothing: up to a tenth of the carrier
};

class SampledLine : public EdgeSource {
 public:
  /// Reads the first stretch. The capture must outlive it.
  SampledLine(SampleCapture& capture, const LineKeying& keying);

  /// 0 of a voltage.
  dsp::Hertz carrier() const { return carrier_; }
  /// How long the silence is that was passed over.
  dsp::Seconds passed_over() const { return passed_over_; }
  /// Whether anything but silence was found.
  bool is_heard() const { return is_heard_; }

  bool initial() const override { return initial_; }
  std::optional<dsp::Seconds> next() override;
  dsp::Seconds known_until() const override;
  dsp::Seconds resolution() const override { return dsp::period(rate_); }

 private:
  using Samples = std::vector<std::complex<float>>;

  Samples read_stretch();
  Samples read_first(const LineKeying& keying);
  bool tells(const Samples& stretch, const LineKeying& keying);
  void make_detector(const LineKeying& keying);
  std::vector<double> strengths(const Samples& samples);
  void find_levels(const std::vector<double>& first);
  void slice(double strength);
  void follow(double strength);

  SampleCapture& capture_;
  dsp::Hertz rate_, carrier_;
  std::optional<EnvelopeDetector> detector_;
  bool light_ = false;  // the line is 0 where it is strong
  bool is_heard_ = false;
  dsp::Seconds passed_over_;
  bool strong_ = false, initial_ = true;
  double weak_level_ = 0, strong_level_ = 0, step_ = 0;
  std::uint64_t count_ = 0;  // of samples sliced, or skipped
  double last_ = 0;
  double crossed_ = 0;  // the last time that it came to the other side, in samples
  std::deque<dsp::Seconds> edges_;
};

}  // namespace sim
