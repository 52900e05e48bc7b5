#include "sim/check/paired_losses.hpp"

#include <boost/math/special_functions/beta.hpp>

namespace sim {
namespace {

using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

/// P(X >= k) of a binomial, k >= 1: the regularised incomplete beta function.
double upper_tail(std::uint64_t n, std::uint64_t k, double probability) {
  return boost::math::ibeta(static_cast<double>(k), static_cast<double>(n - k) + 1, probability,
                            InDouble());
}

double worse_p_value(std::uint64_t discordant, std::uint64_t candidate_only) {
  return candidate_only == 0 ? 1 : upper_tail(discordant, candidate_only, 0.5);
}

/// The frames that the baseline alone loses are as many as that or more.
double no_worse_p_value(std::uint64_t discordant, std::uint64_t candidate_only, double worse_than) {
  if (candidate_only == discordant) return 1;
  return upper_tail(discordant, discordant - candidate_only, 1 / (1 + worse_than));
}

/// The first of 0 ... end of which `holds` is true, as of all behind it; it need not be asked of
/// `end`.
template <class Holds>
std::uint64_t first_that(const Holds& holds, std::uint64_t end) {
  std::uint64_t begin = 0;
  while (begin < end) {
    const std::uint64_t middle = begin + (end - begin) / 2;
    if (holds(middle))
      end = middle;
    else
      begin = middle + 1;
  }
  return end;
}

}  // namespace

void PairedLosses::add(bool candidate_lost, bool baseline_lost) {
  ++frames;
  both += candidate_lost && baseline_lost;
  candidate_only += candidate_lost && !baseline_lost;
  baseline_only += !candidate_lost && baseline_lost;
}

double mcnemar_p_value(const PairedLosses& losses) {
  return worse_p_value(losses.discordant(), losses.candidate_only);
}

double no_worse_p_value(const PairedLosses& losses, double worse_than) {
  return no_worse_p_value(losses.discordant(), losses.candidate_only, worse_than);
}

std::uint64_t mcnemar_critical(std::uint64_t discordant, double alpha) {
  return first_that([&](std::uint64_t n) { return worse_p_value(discordant, n) <= alpha; },
                    discordant + 1);
}

std::uint64_t no_worse_critical(std::uint64_t discordant, double worse_than, double beta) {
  return first_that(
      [&](std::uint64_t n) { return no_worse_p_value(discordant, n, worse_than) > beta; },
      discordant + 1);
}

}  // namespace sim
