#pragma once
// A sequential test of a decoder's regression: frame by frame on the same light, is the candidate
// worse than the baseline? It looks a few times on the way and stops when it knows, with errors
// that hold for all looks together:
//   * a candidate that loses no more than the baseline fails with probability alpha at most: at
//     each look McNemar's exact test with its share of alpha;
//   * one that loses `worse_than` times as much or more, and more than is negligible, passes with
//     probability 1 - power at most: a third of it at any look, where its losses are that much
//     evidence against it (a test martingale: Ville 1939; Ramdas et al., Statistical Science 38
//     (2023) 576), be they lost by both or by one; a third at the last, by the exact test of the
//     discordant frames; a third there, where its loss is shown to be negligible (Clopper &
//     Pearson);
//   * between the two either may come, or neither: undecided.
#include <cstdint>
#include <vector>

#include "sim/check/paired_losses.hpp"

namespace sim {

struct SequentialTestRule {
  double worse_than = 1.5;  // times as many lost frames; more than 1
  double alpha = 1e-3;      // of a false alarm, all points together
  double power = 0.99;      // of not passing what is that much worse
  double negligible = 0;    // frame loss that is worse than nothing else
};

/// Of a check that is told nothing else.
inline constexpr SequentialTestRule rule_of_checks{
    .worse_than = 1.5, .alpha = 1e-3, .power = 0.99, .negligible = 0.01};

/// Of losses and of wrong accepts, among which a check of so many points shares out alpha.
constexpr std::uint64_t tests_of_points(std::uint64_t points) { return 2 * points; }

/// After how many frames it is looked, and which part of alpha each look has.
struct SequentialTestLook {
  std::uint64_t frames;
  double share;
};

/// Looks on the way to `frames`, each at twice the frames of the one before; the last is there and
/// has half of alpha.
std::vector<SequentialTestLook> sequential_test_looks(std::uint64_t frames);

/// Whether so many lost frames show that the loss is negligible.
bool is_negligible(std::uint64_t lost, std::uint64_t frames, const SequentialTestRule& rule);
/// How many are enough for that where none is lost; 0: none are, as nothing is negligible.
std::uint64_t frames_to_be_negligible(const SequentialTestRule& rule);

/// Evidence against a candidate that loses at least `worse_than` times what the baseline loses: if
/// it does, the expectation is at most 1 however long one goes on.
double evidence_of_being_no_worse(const PairedLosses& losses, double worse_than);

enum class SequentialTestState { undecided, passed, worse };

/// One point of a check.
class SequentialTest {
 public:
  /// `points`: of all the check, among which alpha is shared out for stopping early.
  SequentialTest(const SequentialTestRule& rule, std::uint64_t frames, std::uint64_t points);

  /// Frames of the next look; 0 behind the last.
  std::uint64_t next_look() const;
  /// What is counted at that look.
  void look(const PairedLosses& losses);

  /// `worse` only if it is so whatever other points say.
  SequentialTestState state() const { return state_; }
  /// That such losses come of a candidate that loses no more than the baseline, all looks so far
  /// together.
  double p_value() const { return p_value_; }
  bool has_passed() const { return passed_; }

 private:
  SequentialTestRule rule_;
  double points_;
  std::vector<SequentialTestLook> looks_;
  std::size_t next_ = 0;
  double p_value_ = 1;
  bool passed_ = false;
  SequentialTestState state_ = SequentialTestState::undecided;
};

/// Of two decoders that are compared.
struct LossRatios {
  double baseline, candidate;
};

/// A check of `points` points of `frames` each, at a point where the two lose that (the candidate
/// something, and not both all), each for reasons of its own: decoders that fail on the same light
/// are told apart sooner. How probable it is that the last look finds the candidate worse. The
/// number of discordant frames is taken as Poisson's.
double finding_probability(const SequentialTestRule& rule, const LossRatios& flr,
                           std::uint64_t frames, std::uint64_t points);
/// That where the candidate is `worse_than` times as bad, and how probable it is that the last look
/// lets one pass that is equal; `flr` in (0, 1).
double power_of(const SequentialTestRule& rule, double flr, std::uint64_t frames,
                std::uint64_t points);
double pass_probability(const SequentialTestRule& rule, double flr, std::uint64_t frames);

/// Frames with which both are at least `sureness`; more than 1e9 if so many are not enough.
std::uint64_t frames_needed(const SequentialTestRule& rule, double flr, std::uint64_t points,
                            double sureness);

}  // namespace sim
