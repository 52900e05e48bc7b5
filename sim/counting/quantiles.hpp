#pragma once
// How many standard errors wide an interval is to either side.

namespace sim {

/// Of this two-sided level, where the spread is known from as few values (Student's t).
double student_quantile(double degrees_of_freedom, double level);

/// Where it is known.
double normal_quantile(double level);

}  // namespace sim
