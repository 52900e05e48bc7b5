#pragma once
// A spread over units, and a doubt, as --json writes them.
#include <nlohmann/json_fwd.hpp>

#include "sim/result/unit_spread.hpp"

namespace sim {

/// {"flr", "shares": [{coordinates, "units", "carried", "share"}], "ranges": [{coordinates,
/// "along", "units", "quantiles": [{"quantile", "low", "high"}]}]}. An end beyond the sweep is
/// null, as is the share of no units.
nlohmann::ordered_json json_units(const UnitSpread& spread);

/// {"part", "units", "low", "high"}: where 8 of 10 units end.
nlohmann::ordered_json json_doubt(const RangeDoubt& doubt);

}  // namespace sim
