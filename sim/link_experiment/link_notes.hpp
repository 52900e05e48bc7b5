#pragma once
// What a link says besides its numbers, in the terminal and on the page: cells, marks, notes.
#include <string>

#include "sim/result/ranking.hpp"
#include "sim/result/result.hpp"

namespace sim {

/// Why a point that was measured stopped, and behind it marks: where a model is outside of its
/// range ("! carrier"), and alarms ("!! weights").
std::string closing_text(const LinkPoint& point);

/// A line for each kind of mark in the table: what "! near" or "!! half" means; what a target does
/// to the ratios, and how far theory is from the samples. Empty if there is none of these.
std::string mark_notes(const LinkResult& result);

/// What became of lost frames, all points together: "56 frames lost: nothing heard 12, ..."; empty
/// where none was lost.
std::string loss_reasons(const LinkResult& result);

/// Below the table: what the marks mean, why frames were lost, and where the loss passes the level.
std::string link_notes(const LinkResult& result, const Ranking& ranking);

/// What was not counted: points that a stopped run left, and shards. Empty if nothing is missing.
std::string missing_lines(const LinkResult& result);

}  // namespace sim
