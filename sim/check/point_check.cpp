#include "sim/check/point_check.hpp"

#include <algorithm>
#include <cmath>

#include "sim/check/unpaired_losses.hpp"
#include "sim/counting/holm.hpp"

namespace sim {
namespace {

/// Both decoders' outcomes of the frames of a point, as far as they were asked for.
class FramePairs {
 public:
  FramePairs(const CheckSetup& setup, const JudgedPoint& point, const BaselinePoint& baseline,
             const Workers& workers)
      : setup_(setup), stored_(baseline), workers_(workers), judged_(judged_link(point)) {}

  std::uint64_t limit() const {
    const std::uint64_t stored = stored_.frames.size();
    return setup_.frames == 0 ? stored : std::min(stored, setup_.frames);
  }

  /// Whether all is well: no fault, no interrupt.
  bool extend_to(std::uint64_t frames) {
    while (candidate_.size() < frames && !fault_ && !workers_.interrupted()) {
      const std::uint64_t wanted = round_up(frames) - candidate_.size();
      decode(static_cast<std::uint32_t>(std::min(wanted, limit() - candidate_.size())));
    }
    return !fault_ && !workers_.interrupted();
  }

  Pairing pairing() const { return pairing_; }
  const std::optional<DecoderFault>& fault() const { return fault_; }
  const FrameOutcome& candidate(std::size_t i) const { return candidate_[i].outcome; }
  const FrameOutcome& baseline(std::size_t i) const { return baseline_[i]; }

 private:
  static std::uint64_t round_up(std::uint64_t frames) {
    return (frames + frames_per_capture - 1) / frames_per_capture * frames_per_capture;
  }

  void decode(std::uint32_t n) {
    std::vector<const Decoder*> decoders{&setup_.candidate};
    if (pairing_ == Pairing::decoded) decoders.push_back(setup_.baseline);
    const auto first = static_cast<std::uint32_t>(candidate_.size());
    const auto decoded = decode_frames(judged_, decoders, first, n, workers_);
    if (workers_.interrupted()) return;
    fault_ = decoded[0].fault;
    if (pairing_ == Pairing::stored && !is_same_light(decoded[0], first)) return change_pairing();
    const auto& frames = decoded[0].frames;
    candidate_.insert(candidate_.end(), frames.begin(), frames.end());
    for (std::size_t i = 0; i < frames.size(); ++i)
      baseline_.push_back(pairing_ == Pairing::decoded ? decoded[1].frames[i].outcome
                                                       : stored_.frames[first + i].outcome);
  }

  bool is_same_light(const DecodedFrames& decoded, std::size_t first) const {
    for (std::size_t i = 0; i < decoded.frames.size(); ++i)
      if (decoded.frames[i].light != stored_.frames[first + i].light) return false;
    return true;
  }

  /// All is decoded again, from the first frame on.
  void change_pairing() {
    pairing_ = setup_.baseline != nullptr ? Pairing::decoded : Pairing::unpaired;
    candidate_.clear();
    baseline_.clear();
  }

  const CheckSetup& setup_;
  const BaselinePoint& stored_;
  const Workers& workers_;
  JudgedLink judged_;
  Pairing pairing_ = Pairing::stored;
  std::vector<FrameRecord> candidate_;
  std::vector<FrameOutcome> baseline_;
  std::optional<DecoderFault> fault_;
};

/// Counts frames that were not counted before, up to `frames`.
class PairCounter {
 public:
  PairCounter(const FramePairs& pairs, PointCheck& check) : pairs_(pairs), check_(check) {}

  void count_to(std::uint64_t frames) {
    for (; next_ < frames; ++next_) {
      const FrameOutcome &c = pairs_.candidate(next_), &b = pairs_.baseline(next_);
      if (!b.unknown) count(c, b);
    }
  }

 private:
  void count(const FrameOutcome& c, const FrameOutcome& b) {
    const auto trial = static_cast<std::uint32_t>(next_);
    check_.candidate.add(c);
    check_.baseline.add(b);
    check_.losses.add(c.lost(), b.lost());
    check_.undetected_errors.add(c.undetected_error, b.undetected_error);
    if (c.lost() && !b.lost()) check_.only_candidate_lost.push_back(trial);
    if (!c.lost() && b.lost()) check_.only_baseline_lost.push_back(trial);
    if (c.undetected_error && !b.undetected_error)
      check_.only_candidate_undetected.push_back(trial);
  }

  const FramePairs& pairs_;
  PointCheck& check_;
  std::uint64_t next_ = 0;
};

std::uint64_t tests_of(const CheckSetup& setup) { return tests_of_points(setup.points); }

/// Whether the candidate's wrong accepts are told: few losses end a point soon, and say nothing of
/// these.
bool are_wrong_accepts_told(const SequentialTest& test, const PairedLosses& counted,
                            const SequentialTestRule& rule) {
  return test.state() != SequentialTestState::undecided ||
         is_negligible(counted.lost_by_candidate(), counted.frames, rule);
}

/// Look by look, until it is known.
void check_pairs(const CheckSetup& setup, FramePairs& pairs, PointCheck& check) {
  SequentialTest losses(setup.rule, pairs.limit(), tests_of(setup));
  SequentialTest undetected_errors(setup.rule, pairs.limit(), tests_of(setup));
  PairCounter counter(pairs, check);
  const auto undecided = [&] {
    const bool is_worse = losses.state() == SequentialTestState::worse ||
                          undetected_errors.state() == SequentialTestState::worse;
    const bool are_told =
        losses.state() != SequentialTestState::undecided &&
        are_wrong_accepts_told(undetected_errors, check.undetected_errors, setup.rule);
    return !is_worse && !are_told;
  };
  while ((undecided() || setup.golden) && losses.next_look() > 0) {
    const std::uint64_t frames = losses.next_look();
    if (!pairs.extend_to(frames)) return;
    if (pairs.pairing() == Pairing::unpaired) return;
    counter.count_to(frames);
    losses.look(check.losses);
    undetected_errors.look(check.undetected_errors);
  }
  check.p_lost = losses.p_value();
  check.p_undetected = undetected_errors.p_value();
  check.no_worse = losses.has_passed();
}

FrameCounts counts_of(const BaselinePoint& baseline) {
  FrameCounts counts;
  for (const FrameRecord& frame : baseline.frames)
    if (!frame.outcome.unknown) counts.add(frame.outcome);
  return counts;
}

/// All frames of both, which are not the same.
void check_unpaired(const CheckSetup& setup, const BaselinePoint& baseline, FramePairs& pairs,
                    PointCheck& check) {
  check = {.point = check.point};
  if (!pairs.extend_to(pairs.limit())) return;
  for (std::uint64_t i = 0; i < pairs.limit(); ++i) check.candidate.add(pairs.candidate(i));
  check.baseline = counts_of(baseline);
  const LostOf c{check.candidate.lost, check.candidate.frames};
  const LostOf b{check.baseline.lost, check.baseline.frames};
  check.p_lost = fisher_p_value(c, b);
  check.p_undetected = fisher_p_value({check.candidate.undetected_error, c.frames},
                                      {check.baseline.undetected_error, b.frames});
  check.no_worse =
      fisher_no_worse_p_value(c, b, setup.rule.worse_than) <= (1 - setup.rule.power) / 3 ||
      is_negligible(c.lost, c.frames, setup.rule);
}

void add_power(const CheckSetup& setup, const BaselinePoint& baseline, PointCheck& check) {
  const FrameCounts all = counts_of(baseline);
  if (all.lost == 0 || all.lost == all.frames) return;
  const double flr = static_cast<double>(all.lost) / static_cast<double>(all.frames);
  check.power = power_of(setup.rule, flr, check.limit, tests_of(setup));
  check.frames_needed = frames_needed(setup.rule, flr, tests_of(setup), setup.rule.power);
}

bool is_same(const PointCheck& check) {
  return check.pairing == Pairing::stored && check.losses.discordant() == 0 &&
         check.undetected_errors.discordant() == 0;
}

/// Whether it accepts more that was not sent than an equal one would in most checks.
bool seems_to_accept_more(const PointCheck& check, const SequentialTestRule& rule) {
  return check.p_undetected <= 1 - rule.power;
}

Verdict verdict_of(const PointCheck& check, bool worse, const CheckSetup& setup) {
  if (check.fault) return Verdict::broken;
  if (setup.golden) return is_same(check) ? Verdict::passed : Verdict::worse;
  if (worse) return Verdict::worse;
  const bool passes = check.no_worse && !seems_to_accept_more(check, setup.rule);
  return passes ? Verdict::passed : Verdict::inconclusive;
}

}  // namespace

PointCheck check_point(const CheckSetup& setup, const JudgedPoint& point,
                       const BaselinePoint& baseline, const Workers& workers) {
  PointCheck check{.point = point};
  FramePairs pairs(setup, point, baseline, workers);
  check_pairs(setup, pairs, check);
  if (pairs.pairing() == Pairing::unpaired) check_unpaired(setup, baseline, pairs, check);
  check.pairing = pairs.pairing();
  check.fault = pairs.fault();
  check.limit = pairs.limit();
  add_power(setup, baseline, check);
  return check;
}

void judge(std::vector<PointCheck>& checks, const CheckSetup& setup) {
  std::vector<double> p_values;
  for (const PointCheck& check : checks) {
    p_values.push_back(check.p_lost);
    p_values.push_back(check.p_undetected);
  }
  const std::vector<bool> worse = rejected_by_holm(p_values, setup.rule.alpha);
  for (std::size_t i = 0; i < checks.size(); ++i)
    checks[i].verdict = verdict_of(checks[i], worse[2 * i] || worse[2 * i + 1], setup);
}

Verdict verdict_of(const std::vector<PointCheck>& checks) {
  const auto any = [&](Verdict verdict) {
    return std::ranges::find(checks, verdict, &PointCheck::verdict) != checks.end();
  };
  for (const Verdict verdict : {Verdict::broken, Verdict::worse, Verdict::inconclusive})
    if (any(verdict)) return verdict;
  return Verdict::passed;
}

}  // namespace sim
