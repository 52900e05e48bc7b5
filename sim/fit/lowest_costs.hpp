#pragma once
// The lowest costs of those met so far: what is dearer than each of them need not be known to its
// end.
#include <cmath>
#include <cstddef>
#include <queue>

namespace sim {

class LowestCosts {
 public:
  explicit LowestCosts(std::size_t kept) : kept_(kept) {}

  /// A cost beyond it is none of the lowest; infinite while there are too few.
  double most() const { return costs_.size() < kept_ ? HUGE_VAL : costs_.top(); }

  void add(double cost) {
    costs_.push(cost);
    if (costs_.size() > kept_) costs_.pop();
  }

 private:
  std::size_t kept_;
  std::priority_queue<double> costs_;
};

}  // namespace sim
