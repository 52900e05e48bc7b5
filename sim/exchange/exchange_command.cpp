#include "sim/exchange/exchange_command.hpp"

#include "sim/exchange/exchange_report.hpp"
#include "sim/report/point_report.hpp"

namespace sim {
namespace {

/// What there is to say of one point more than its row.
std::string details(const LoadedScenario&, const ExchangePoint& point) {
  return direction_table(point);
}

constexpr PointReport<ExchangePoint> exchange_report{exchange_header, exchange_row, details,
                                                     exchange_dataset};

}  // namespace

constinit const ExperimentEngine exchange_engine =
    experiment_engine<exchange_measurement, exchange_report>;

}  // namespace sim
