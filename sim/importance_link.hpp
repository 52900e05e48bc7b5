#pragma once
// What the trials of a point share where they are drawn by importance sampling (sim/method).
#include <Eigen/Core>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "channel/decision.hpp"
#include "channel/receiver_module.hpp"
#include "dsp/truncated_orthant.hpp"

namespace sim {

struct Link;

/// Tilts of orthants of equally spaced readings, whose levels are about a straight line. Worked out
/// once each; safe to use from several threads, and a function of its arguments alone.
class TiltTable {
 public:
  explicit TiltTable(Eigen::MatrixXd cholesky) : cholesky_(std::move(cholesky)) {}
  const dsp::OrthantTilt& of(const Eigen::VectorXd& levels);

 private:
  const Eigen::MatrixXd cholesky_;
  std::mutex mutex_;
  std::map<std::pair<int, int>, dsp::OrthantTilt> tilts_;  // by level and slope, rounded
};

/// About the probability of an orthant.
double likelihood(const dsp::OrthantTilt& tilt);

struct ImportanceLink {
  /// Carrier cycles in a row without a comparator's pulse that make a module's pin give light up;
  /// 1: a matched receiver, which decides by one number a bit.
  int readings = 1;
  channel::CorrelatorOutput output{};  // of a matched receiver
  std::unique_ptr<TiltTable> tilts{};
};

/// Of a module's link that is complete but for this.
std::shared_ptr<const ImportanceLink> make_importance_link(const Link& link);
/// Of a matched receiver that measures this.
std::shared_ptr<const ImportanceLink> make_importance_link(const channel::CorrelatorOutput& output);

}  // namespace sim
