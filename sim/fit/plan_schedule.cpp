#include "sim/fit/plan_schedule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "sim/failure.hpp"

namespace sim {
namespace {

/// Bursts, and the dark before them.
struct TrialBursts {
  double rest_ms = 0;
  double level_db = 0;
  std::uint32_t on = 30, off = 0, repeats = 1;
  double carrier = 1;  // over the module's
};

/// What is not to be torn apart.
using BenchTrial = std::vector<TrialBursts>;
using BenchTrials = std::vector<BenchTrial>;

/// The constants of the module that choose bursts and gaps, within what a plan can use: a module
/// without a gain control has none, and the one to be measured may have others.
struct ExpectedModule {
  double carrier_hz;
  double long_burst = 0, min_gap = 0;  // cycles
  double duty = 0;

  explicit ExpectedModule(const channel::ModuleData& like) : carrier_hz(like.centre_hz) {
    const bool has_rule = like.agc_attack_db_per_ms != 0;
    const channel::ModuleData rule = has_rule ? like : channel::ModuleData{};
    long_burst = std::clamp(rule.agc_long_burst_cycles, 30.0, 120.0);
    min_gap = std::clamp(rule.agc_min_gap_cycles, 8.0, 40.0);
    duty = std::clamp(rule.agc_max_duty, 0.08, 0.5);
  }

  std::uint32_t cycles(double ms) const { return whole(ms * 1e-3 * carrier_hz); }
  static std::uint32_t whole(double cycles) {
    return static_cast<std::uint32_t>(std::lround(std::max(cycles, 1.0)));
  }
};

/// Bursts that come so often and last so long together.
TrialBursts train(double level_db, std::uint32_t on, std::uint32_t period, double cycles) {
  return {.level_db = level_db,
          .on = on,
          .off = std::max(period, on + 1) - on,
          .repeats = ExpectedModule::whole(cycles / std::max(period, on + 1))};
}

bool is_odd(int pass) { return pass % 2 != 0; }

BenchTrial mark(const ExpectedModule& module) {
  TrialBursts bursts = train(0, 30, module.cycles(10), module.cycles(50));
  bursts.rest_ms = 100;
  return {bursts};
}

/// Of 30 cycles each 10 ms; on another carrier in as many cycles.
TrialBursts single_bursts(const ExpectedModule& module, double level_db, double carrier) {
  TrialBursts bursts = train(level_db, 30, module.cycles(10), module.cycles(300));
  bursts.rest_ms = 100;
  bursts.carrier = carrier;
  return bursts;
}

/// Odd passes have levels between those of even ones, here and below: each level of a bench is
/// wrong by its own error, so the same one again tells little.
BenchTrials emin_part(const ExpectedModule& module, int pass) {
  constexpr std::array even{-40, -46, -50, -54, -58}, odd{-44, -48, -52, -56, -61};
  BenchTrials trials;
  for (const int level_db : is_odd(pass) ? odd : even)
    trials.push_back({single_bursts(module, level_db, 1)});
  return trials;
}

/// The further off the carrier, the less of it passes the resonator.
BenchTrials tune_part(const ExpectedModule& module, int pass) {
  struct Side {
    double off;
    int strongest_db;
  };
  const int weaker_db = is_odd(pass) ? 2 : 0;
  BenchTrials trials;
  for (const auto& [off, strongest_db] : {Side{0.05, -40}, Side{0.1, -36}})
    for (const int below_db : {0, 4, 8, 12})
      for (const double carrier : {1 - off, 1 + off})
        trials.push_back({single_bursts(module, strongest_db - weaker_db - below_db, carrier)});
  return trials;
}

/// Weak short bursts, one a period, for so long.
TrialBursts following_bursts(const ExpectedModule& module, double level_db, double period_ms,
                             double all_ms) {
  TrialBursts bursts = train(level_db, 20, module.cycles(period_ms), module.cycles(all_ms));
  bursts.rest_ms = period_ms;
  return bursts;
}

/// Behind a carrier: those that come first are dense, for parts that come back at once, the others
/// seldom, for parts that wait until it has been dark for a while.
void follow_by_short_bursts(const ExpectedModule& module, double level_db, BenchTrial& trial) {
  trial.push_back(following_bursts(module, level_db, 3.5, 350));
  trial.push_back(following_bursts(module, level_db, 40, 1050));
}

/// The weakest first, as the strongest leave the gain low for longest. Weaker bursts behind the
/// strong ones tell how far the gain has fallen, where the output never lets go.
BenchTrials attack_part(const ExpectedModule& module, int pass) {
  constexpr int step_db = 8, weakest_followed_db = -32, weaker_db = 16;
  const int weakest_db = is_odd(pass) ? -52 : -56;
  BenchTrials trials;
  for (int level_db = weakest_db; level_db <= 0; level_db += step_db) {
    trials.push_back({{.rest_ms = 1800, .level_db = 1.0 * level_db, .on = module.cycles(1200)}});
    if (level_db >= weakest_followed_db)
      follow_by_short_bursts(module, level_db - weaker_db, trials.back());
  }
  return trials;
}

/// Dense bursts keep the gain of some parts where they are nearly reported, so seldom ones alone
/// tell how it comes back from afar.
BenchTrials release_part(const ExpectedModule& module) {
  struct Release {
    double carrier_db, weaker_db;
    double period_ms = 0;  // of seldom ones alone
  };
  constexpr Release all[]{{-16, 8},  {-8, 36, 32}, {-16, 16}, {-16, 0},     {0, 42, 35},
                          {-16, 20}, {-8, 28, 45}, {-16, 4},  {-8, 22, 38}, {-16, 12}};
  constexpr double all_ms = 1400;
  BenchTrials trials;
  for (const auto& [carrier_db, weaker_db, period_ms] : all) {
    trials.push_back({{.rest_ms = 1200, .level_db = carrier_db, .on = module.cycles(1200)}});
    const double level_db = carrier_db - weaker_db;
    if (period_ms > 0)
      trials.back().push_back(following_bursts(module, level_db, period_ms, all_ms));
    else
      follow_by_short_bursts(module, level_db, trials.back());
  }
  return trials;
}

/// Near Emin, where little gain is to be lost until the output lets go.
constexpr double held_level_db = -38;
/// Nearer still: bursts that charge only a little let go there, if they come often.
constexpr double weakly_held_level_db = -46;

BenchTrial held_train(const ExpectedModule& module, double on, double duty,
                      double level_db = held_level_db) {
  const std::uint32_t cycles = ExpectedModule::whole(on);
  TrialBursts bursts =
      train(level_db, cycles, ExpectedModule::whole(on / std::min(duty, 0.9)), module.cycles(2000));
  constexpr std::uint32_t enough = 300;  // the gain has let go of it by then, or never does
  bursts.repeats = std::min(bursts.repeats, enough);
  bursts.rest_ms = 900;
  return {bursts};
}

/// No denser than the sketch can send: two edges a burst.
BenchTrial short_train(const ExpectedModule& module, double on, double gap,
                       double level_db = held_level_db) {
  constexpr double densest_ms = 0.6;
  const double period = std::max(on + gap, 1.0 * module.cycles(densest_ms));
  return held_train(module, on, on / period, level_db);
}

/// Round by round: bursts of each length at another duty or gap, those that are expected to be the
/// last that are held first.
BenchTrials held_part(const ExpectedModule& module, int pass) {
  constexpr std::array rounds{1.0, 0.5, 1.35, 0.7, 1.7, 0.85, 1.15, 0.3};
  constexpr std::array<double, 4> long_bursts{98.0 / 80, 150.0 / 80, 300.0 / 80, 600.0 / 80};
  constexpr std::array<double, 5> lengths{0.82, 0.9, 0.98, 1.05, 1.12};
  const double between = is_odd(pass) ? 1.08 : 1;
  const double short_burst = 0.75 * module.long_burst;
  BenchTrials trials;
  for (std::size_t round = 0; round < rounds.size(); ++round) {
    for (const double length : long_bursts)
      trials.push_back(
          held_train(module, length * module.long_burst, rounds[round] * between * module.duty));
    const double gap = module.min_gap * rounds[round] * between;
    trials.push_back(short_train(module, short_burst, gap));
    if (round >= lengths.size()) continue;
    const double on = lengths[round] * module.long_burst;  // which of them is still a short one
    trials.push_back(short_train(module, on, 1.5 * module.min_gap));
  }
  return trials;
}

/// Which bursts are short, and which gaps end one: bursts so dense that they are let go of where
/// they count. The third is as long as a bit of 600 baud for a TSOP4856.
BenchTrials short_part(const ExpectedModule& module) {
  constexpr std::array lengths{0.9, 0.5, 1.165, 0.7, 1.35};
  constexpr std::array gaps{1.2, 0.8, 1.6, 0.5, 2.2};
  BenchTrials trials;
  for (std::size_t round = 0; round < gaps.size(); ++round) {
    for (std::size_t i = 0; i < lengths.size(); ++i)
      trials.push_back(short_train(module, lengths[i] * module.long_burst,
                                   gaps[(i + round) % gaps.size()] * module.min_gap));
    trials.push_back(short_train(module, 0.8 * module.long_burst, gaps[round] * module.min_gap,
                                 weakly_held_level_db));
  }
  return trials;
}

/// Short bursts that come so densely, and so many of them, that the gain falls for them too where
/// they are charged but a little.
BenchTrials dense_part(const ExpectedModule& module) {
  struct Train {
    double length, gap, level_db;
  };
  constexpr double weakest_db = -50;
  constexpr Train all[]{{0.45, 1.4, held_level_db},
                        {0.9, 1.05, weakly_held_level_db},
                        {0.525, 0.75, weakly_held_level_db},
                        {0.45, 1.5, held_level_db},
                        {0.75, 0.65, held_level_db},
                        {0.75, 1.05, weakly_held_level_db},
                        {0.45, 1.2, held_level_db},
                        {0.9, 0.9, weakly_held_level_db},
                        {0.9, 1.05, weakest_db},
                        {0.6, 0.9, weakly_held_level_db},
                        {0.75, 1.2, held_level_db},
                        {0.6, 0.65, held_level_db}};
  constexpr std::uint32_t many = 1000;
  BenchTrials trials;
  for (const auto& [length, gap, level_db] : all) {
    trials.push_back(
        short_train(module, length * module.long_burst, gap * module.min_gap, level_db));
    trials.back().front().repeats = many;
  }
  return trials;
}

/// Those of a list one after the other, with those of a shorter one spread among them.
BenchTrials spread(const BenchTrials& few, const BenchTrials& many) {
  BenchTrials trials;
  std::size_t next = 0;
  for (std::size_t i = 0; i < many.size(); ++i) {
    for (; next < few.size() && next * many.size() <= i * few.size(); ++next)
      trials.push_back(few[next]);
    trials.push_back(many[i]);
  }
  return trials;
}

void append(BenchTrials& to, const BenchTrials& more) {
  to.insert(to.end(), more.begin(), more.end());
}

/// All parts once. Trains begin with the first pass, those that are short or dense with the second.
BenchTrials trials_of_pass(const ExpectedModule& module, int pass) {
  const BenchTrials held = held_part(module, pass);
  BenchTrials trials = emin_part(module, pass);
  append(trials, tune_part(module, pass));
  append(trials, attack_part(module, pass));
  if (pass == 0) {
    append(trials, spread(release_part(module), held));
  } else {
    append(trials, short_part(module));
    append(trials, dense_part(module));
    append(trials, held);
    append(trials, release_part(module));
  }
  return trials;
}

/// Trials in clocks, as long as there is time.
class ScheduleWriter {
 public:
  ScheduleWriter(const channel::EmitterData& led, double carrier_hz, double minutes)
      : carrier_hz_(carrier_hz),
        levels_(led, period_of(1)),
        left_(60 * minutes * bench_clock_hz - ticks_of(tail_ms)) {}

  bool fits(const BenchTrial& trial) const {
    double clocks = 0;
    for (const TrialBursts& bursts : trial) clocks += clocks_of_bursts(bursts);
    return clocks <= left_;
  }

  void take(const BenchTrial& trial) {
    for (const TrialBursts& bursts : trial) {
      left_ -= clocks_of_bursts(bursts);
      schedule_.steps.push_back(step_of(bursts));
    }
  }

  BenchSchedule finished() {
    schedule_.tail = lead_of(tail_ms, schedule_.steps.back().period);
    return std::move(schedule_);
  }

 private:
  static constexpr double tail_ms = 500;
  static double ticks_of(double ms) { return ms * 1e-3 * bench_clock_hz; }

  int period_of(double carrier) const {
    return static_cast<int>(std::lround(bench_clock_hz / (carrier * carrier_hz_)));
  }
  static std::uint32_t lead_of(double ms, int period) {
    return ExpectedModule::whole(std::ceil(ticks_of(ms) / period));
  }

  BenchStep step_of(const TrialBursts& bursts) const {
    const int period = period_of(bursts.carrier);
    return {.period = period,
            .pulse = levels_.pulse(bursts.level_db, period),
            .lead = lead_of(bursts.rest_ms, period),
            .on = bursts.on,
            .off = bursts.off,
            .repeats = bursts.repeats};
  }

  /// With its rest, and a little more for the changes between carriers.
  double clocks_of_bursts(const TrialBursts& bursts) const {
    const BenchStep step = step_of(bursts);
    return step.period * (step.lead + 2.0 + step.repeats * (1.0 * step.on + own_gap(step)));
  }

  double carrier_hz_;
  BenchLevels levels_;
  double left_;  // clocks
  BenchSchedule schedule_;
};

void refuse_carrier(const channel::ModuleData& like) {
  constexpr double most_off = 0.1;  // of the carriers of the part `tune`
  const double greatest = bench_clock_hz / shortest_period / (1 + most_off);
  const double least = bench_clock_hz / longest_period / (1 - most_off);
  if (like.centre_hz >= least && like.centre_hz <= greatest) return;
  throw bad_input(fmt::format("{} has its centre at {:g} Hz", like.name, like.centre_hz),
                  fmt::format("the sketch makes carriers for modules of {:.0f} to {:.0f} Hz",
                              std::ceil(least), std::floor(greatest)),
                  "write a plan by hand, for a generator of your own");
}

int first_period(const channel::ModuleData& like) {
  return static_cast<int>(std::lround(bench_clock_hz / like.centre_hz));
}

}  // namespace

void refuse_no_module(const channel::ModuleData& like) {
  if (channel::is_matched(like))
    throw bad_input(like.name, "no module that can be bought", "name one that is like yours");
}

BenchSchedule schedule_for(const channel::ModuleData& like, const channel::EmitterData& led,
                           double minutes) {
  refuse_no_module(like);
  refuse_carrier(like);
  const ExpectedModule module(like);
  ScheduleWriter writer(led, like.centre_hz, minutes);
  writer.take(mark(module));
  for (int pass = 0;; ++pass)
    for (const BenchTrial& trial : trials_of_pass(module, pass)) {
      if (!writer.fits(trial)) return writer.finished();
      writer.take(trial);
    }
}

double bench_distance_m(const channel::ModuleData& like, const channel::EmitterData& led) {
  return std::sqrt(BenchLevels(led, first_period(like)).irradiance_at_1_m() /
                   bench_first_level(like));
}

double bench_first_level(const channel::ModuleData& like) {
  return like.emin_mw_per_m2 * std::pow(10, strongest_above_emin_db / 20);
}

}  // namespace sim
