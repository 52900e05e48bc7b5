#pragma once
// What an experiment says on stdout: a table whose rows can be printed one by one as points finish.
// Numbers carry the digits that their interval supports; "-" is not known.
#include <string>
#include <vector>

#include "sim/result/result.hpp"

namespace sim {

/// Three lines (names and units), each ended by a newline. `theory`: with a column for what theory
/// says beside the bit error ratio.
std::string table_header(const std::vector<Axis>& axes, bool theory = false);

/// One line, in the columns of table_header(axes, theory).
std::string table_row(const std::vector<Axis>& axes, const PointResult& point, double ci_level,
                      bool theory = false);

/// As the table has them; "-" where they are not known, or there is no noise.
std::string irradiance_text(double value);
std::string decibel_text(double value);

/// What theory says of bit errors; "-" where it says nothing.
std::string theory_text(double ber);

/// Why a point that was measured stopped, and behind it marks: where a model is outside of its
/// range ("! carrier"), and alarms ("!! weights").
std::string closing_text(const PointResult& point);

/// A line for each kind of mark in the table: what "! near" or "!! half" means; what a target does
/// to the ratios, and how far theory is from the samples. Empty if there is none of these.
std::string mark_notes(const ExperimentResult& result);

/// What became of lost frames, all points together: "56 frames lost: nothing heard 12, ..."; empty
/// where none was lost.
std::string loss_reasons(const ExperimentResult& result);

/// Whether a stopped run left points unfinished, of which lines below say nothing; else empty.
std::string unfinished_note(const ExperimentResult& result);
/// The same of so many points.
std::string unfinished_note(std::size_t all, std::size_t finished, std::size_t begun);

}  // namespace sim
