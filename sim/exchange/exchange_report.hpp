#pragma once
// What people and programs read of an exchange.
#include <string>
#include <vector>

#include "sim/exchange/exchange_experiment.hpp"
#include "sim/result/dataset.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Of the time, for ages.
inline constexpr double high_share = 0.95;

std::string exchange_header(const LoadedScenario& scenario);
std::string exchange_row(const LoadedScenario& scenario, const ExchangePoint& point);
/// Each direction of one point, and why messages were refused.
std::string direction_table(const ExchangePoint& point);

Dataset exchange_dataset(const LoadedScenario& scenario, const std::string& command,
                         const std::vector<ExchangePoint>& points);

}  // namespace sim
