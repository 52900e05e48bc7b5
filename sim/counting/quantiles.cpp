#include "sim/counting/quantiles.hpp"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace sim {
namespace {

/// In double and not in long double: seven times as fast, within 3e-15. Rules of stopping ask
/// often.
using AsDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

}  // namespace

double student_quantile(double degrees_of_freedom, double level) {
  const boost::math::students_t_distribution<double, AsDouble> t(degrees_of_freedom);
  return quantile(complement(t, (1 - level) / 2));
}

double normal_quantile(double level) {
  const boost::math::normal_distribution<double, AsDouble> normal;
  return quantile(complement(normal, (1 - level) / 2));
}

}  // namespace sim
