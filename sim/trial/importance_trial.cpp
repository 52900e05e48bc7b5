#include "sim/trial/importance_trial.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "sim/threads/stopwatch.hpp"
#include "sim/trial/drawn_trials.hpp"
#include "sim/trial/matched_proposal.hpp"
#include "sim/trial/module_proposal.hpp"

namespace sim {
namespace {

/// A trial that nothing is known against is run this much as often as the average.
constexpr double least_chance = 0.1;

std::vector<TrialProposal> proposals_of(const Link& link, const DrawnTrials& drawn,
                                        const std::atomic<bool>* stop, channel::StageClock* clock) {
  if (!link.ideal) return module_proposals(link, drawn, stop, clock);
  std::vector<TrialProposal> proposals;
  for (std::size_t i = 0; i < drawn.sent.size(); ++i)
    proposals.push_back(matched_proposal(link, drawn.sent[i], drawn.inputs[i].carrier_phase));
  return proposals;
}

/// Which trial of its group is run, and with what weight as against all of them once.
struct Choice {
  std::size_t trial;
  double weight;
};

class Chooser {
 public:
  explicit Chooser(std::span<const TrialProposal> proposals) {
    double sum = 0;
    for (const TrialProposal& p : proposals) sum += std::min(1.0, p.proposal.likelihood());
    const auto n = static_cast<double>(proposals.size());
    for (const TrialProposal& p : proposals) {
      const double chance = std::min(1.0, p.proposal.likelihood()) + least_chance * sum / n;
      chances_.push_back(sum > 0 ? chance / (sum * (1 + least_chance)) : 1 / n);
    }
  }

  Choice operator()(double uniform) const {
    std::size_t i = 0;
    for (; i + 1 < chances_.size() && uniform >= chances_[i]; ++i) uniform -= chances_[i];
    return {i, 1 / (chances_[i] * static_cast<double>(chances_.size()))};
  }

 private:
  std::vector<double> chances_;
};

/// The runs of some groups, as many as there are trials.
struct Runs {
  std::vector<Choice> choices{};
  std::vector<TrialNoise> noises{};
  std::vector<const Transmission*> sent{};
  std::vector<channel::ChainInput> inputs{};
};

/// Some trials that are drawn together, and how.
struct Trials {
  std::uint32_t first;
  DrawnTrials drawn;
  std::vector<TrialProposal> proposals;
};

void draw_run(const Link& link, std::uint32_t run, const Trials& trials, const Choice& choice,
              Runs& runs) {
  const TrialProposal& of = trials.proposals[choice.trial];
  TrialNoise noise(of.stretches, address(link, run, Purpose::prescribed_noise));
  of.proposal.draw(noise, address(link, run, Purpose::proposal));
  channel::ChainInput input = trials.drawn.inputs[choice.trial];
  input.noise_seed = address(link, run, Purpose::noise_around).block(0);
  input.noise_windows = noise.windows();
  runs.choices.push_back(choice);
  runs.noises.push_back(std::move(noise));
  runs.sent.push_back(&trials.drawn.sent[choice.trial]);
  runs.inputs.push_back(std::move(input));
}

/// Each group chooses among its own trials.
Runs draw_runs(const Link& link, const Trials& trials) {
  Runs runs;
  const std::span<const TrialProposal> all(trials.proposals);
  for (const TrialSpan& group : groups_of(all.size())) {
    const Chooser choose(all.subspan(group.first, group.n));
    for (std::size_t i = group.first; i < group.first + group.n; ++i) {
      const std::uint32_t run = trials.first + static_cast<std::uint32_t>(i);
      Choice choice = choose(address(link, run, Purpose::choice).uniform(0));
      choice.trial += group.first;
      draw_run(link, run, trials, choice, runs);
    }
  }
  return runs;
}

/// The weight of a run that counts something; of others it does not matter.
double weight_of(const Tally& counted, const Choice& choice, const TrialProposal& of,
                 const TrialNoise& noise) {
  if (counted.n_bit_errors == 0 && counted.n_frames_lost == 0) return 0;
  return choice.weight / of.proposal.ratio(noise);
}

GroupResult count_runs(const Link& link, const Trials& trials, const Runs& runs,
                       const TrialSpan& group, std::vector<dsp::LogicTrace>& pins) {
  GroupResult result;
  std::vector<double> bit_errors, frames_lost;
  for (std::size_t i = group.first; i < group.first + group.n; ++i) {
    const Choice& choice = runs.choices[i];
    const TrialProposal& of = trials.proposals[choice.trial];
    const auto trial = trials.first + static_cast<std::uint32_t>(choice.trial);
    const Tally counted = count(link, *runs.sent[i], receive(link, trial, std::move(pins[i])));
    const double weight = weight_of(counted, choice, of, runs.noises[i]);
    bit_errors.push_back(weight * static_cast<double>(counted.n_bit_errors));
    frames_lost.push_back(weight * static_cast<double>(counted.n_frames_lost));
    result.tally += counted;
    result.tally.weighted.dark_likelihood += choice.weight * of.dark_likelihood;
    add_cost(result, link, *runs.sent[i]);
  }
  result.tally.weighted.n_groups = 1;
  result.tally.weighted.bit_errors = weighted_sum(bit_errors);
  result.tally.weighted.frames_lost = weighted_sum(frames_lost);
  return result;
}

Trials draw_proposals(const Link& link, std::uint32_t first, int n, const std::atomic<bool>* stop,
                      channel::StageClock* clock) {
  Trials trials{first, draw_trials(link, first, n), {}};
  trials.proposals = proposals_of(link, trials.drawn, stop, clock);
  return trials;
}

}  // namespace

std::vector<GroupResult> run_weighted_groups(const Link& link, std::uint32_t first, int n,
                                             const std::atomic<bool>* stop, bool profiled) {
  Stopwatch watch;
  channel::StageClock clock;
  channel::StageClock* const timed = profiled ? &clock : nullptr;
  const Trials trials = draw_proposals(link, first, n, stop, timed);
  const Runs runs = draw_runs(link, trials);
  std::vector<dsp::LogicTrace> pins = pins_of(link, runs.sent, runs.inputs, stop, timed);
  const double hearing_s = watch.lap();
  std::vector<GroupResult> results;
  for (const TrialSpan& group : groups_of(pins.size()))
    results.push_back(count_runs(link, trials, runs, group, pins));
  if (!profiled) return results;
  double chain = 0;
  for (const double stage : clock.seconds()) chain += stage;
  results.front().profile = {
      .messages_s = hearing_s - chain, .chain_s = clock.seconds(), .decoding_s = watch.seconds()};
  return results;
}

}  // namespace sim
