#pragma once
// What the trials of a point share where they are drawn by importance sampling
// (sim/scenario/method).
#include <Eigen/Core>
#include <atomic>
#include <memory>
#include <vector>

#include "channel/decision.hpp"
#include "channel/receiver_module.hpp"

namespace sim {

struct Link;

/// About how probable it is that equally spaced readings in a row are all at or above their levels,
/// which are about a straight line. Safe to use from several threads, and a function of its
/// arguments alone.
class LikelihoodTable {
 public:
  explicit LikelihoodTable(Eigen::MatrixXd cholesky);
  /// `level`: mean of the levels; `rise`: from one to the next; both in standard deviations.
  double of(double level, double rise) const;

 private:
  double known(int row, int column) const;
  double worked_out(int row, int column) const;

  const Eigen::MatrixXd cholesky_;
  /// ln of the likelihood by level and slope; NaN: not yet asked for. Threads that ask at once work
  /// out the same number.
  mutable std::vector<std::atomic<double>> known_;
};

struct ImportanceLink {
  /// Carrier cycles in a row without a comparator's pulse that make a module's pin give light up;
  /// 1: a matched receiver, which decides by one number a bit.
  int readings = 1;
  channel::CorrelatorOutput output{};  // of a matched receiver
  std::unique_ptr<const LikelihoodTable> likelihoods{};
};

/// Carrier cycles in a row without a comparator's pulse that empty the integrator of a module, or
/// of the unit of its population that needs the fewest.
int missed_cycles(const channel::ModuleData& module, dsp::Hertz carrier, bool population);

/// Of a module's link that is complete but for this.
std::shared_ptr<const ImportanceLink> make_importance_link(const Link& link);
/// Of a matched receiver that measures this.
std::shared_ptr<const ImportanceLink> make_importance_link(const channel::CorrelatorOutput& output);

}  // namespace sim
