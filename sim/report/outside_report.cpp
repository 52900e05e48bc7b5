#include "sim/report/outside_report.hpp"

#include <utility>

#include "sim/link/validity.hpp"
#include "sim/scenario/flags.hpp"

namespace sim {

TextColumn outside_column() { return {{"", "", ""}, -1}; }

std::string outside_mark(std::uint64_t mask) {
  return raised_mark(validity_limits(), mask, outside_sign);
}

Dataset::Variable outside_variable(std::vector<std::int64_t> masks) {
  return {.facts = {outside_name, "1", "models that are outside of their range"},
          .on_axes = true,
          .dimensions = {},
          .values = std::move(masks),
          .flags = flag_names(validity_limits())};
}

std::string outside_notes(const Dataset& data) {
  std::uint64_t raised = 0;
  if (const Dataset::Variable* variable = find_variable(data, outside_name))
    if (const auto* masks = std::get_if<std::vector<std::int64_t>>(&variable->values))
      for (const std::int64_t mask : *masks) raised |= static_cast<std::uint64_t>(mask);
  return raised_notes(validity_limits(), raised, outside_sign);
}

}  // namespace sim
