#include "sim/capture/sample_choice.hpp"

#include <algorithm>

#include "sim/capture/capture_units.hpp"
#include "sim/capture/sampled_line.hpp"

namespace sim {
namespace {

constexpr std::size_t most_surveyed_samples = 4'000'000;

/// The first samples of a capture.
class FirstSamples : public SampleCapture {
 public:
  explicit FirstSamples(SampleCapture& samples) : samples_(samples) {}

  dsp::Hertz sample_rate() const override { return samples_.sample_rate(); }
  bool is_complex() const override { return samples_.is_complex(); }

  std::size_t read(std::span<std::complex<float>> to) override {
    const std::size_t count = samples_.read(to.first(std::min(to.size(), left_)));
    left_ -= count;
    return count;
  }

 private:
  SampleCapture& samples_;
  std::size_t left_ = most_surveyed_samples;
};

}  // namespace

ChannelSurvey survey_of_samples(std::string name, SampleCapture& samples, const LineHints& hints) {
  FirstSamples first(samples);
  SampledLine line(first, {hints.carrier, hints.baud});
  return survey_of(std::move(name), line, hints);
}

void take_samples(const std::string& file, const SampleChannels& channels,
                  const CaptureSettings& settings, Capture& capture) {
  CaptureFacts& facts = capture.facts;
  const bool looks = settings.wire.empty() && channels.names.size() > 1 && channels.opens_again;
  if (looks) {
    std::vector<ChannelSurvey> surveys;
    for (std::size_t i = 0; i < channels.names.size(); ++i)
      surveys.push_back(survey_of_samples(channels.names[i], *channels.open(i), settings.hints));
    facts.is_whole = false;
    facts.taken = take_choice(surveys, facts);
  } else {
    for (const std::string& name : channels.names) facts.channels.push_back({name, std::nullopt});
    facts.taken = settings.wire.empty() ? 0 : named_channel(channels.names, settings.wire, file);
    if (settings.wire.empty() && channels.names.size() > 1)
      facts.assumed.emplace_back("the first channel");
  }
  capture.samples = channels.open(*facts.taken);
  facts.time = samples_text(capture.samples->sample_rate());
}

}  // namespace sim
