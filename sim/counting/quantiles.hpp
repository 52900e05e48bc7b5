#pragma once
// Student's t: what an interval takes in place of the normal where a spread is known from a few.

namespace sim {

/// Half the width, in standard errors, of a two-sided interval of this level.
double student_quantile(double degrees_of_freedom, double level);

/// The same where the spread is known.
double normal_quantile(double level);

}  // namespace sim
