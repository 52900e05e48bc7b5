#include "sim/columns/validity_column.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/link/validity.hpp"
#include "sim/scenario/flags.hpp"

namespace sim {

std::string validity_mark(std::uint64_t mask) {
  return raised_mark(validity_limits(), mask, validity_sign);
}

std::vector<std::string> validity_flag_names() { return flag_names(validity_limits()); }

std::string validity_notes(const Dataset& data) {
  std::uint64_t raised = 0;
  if (const Dataset::Variable* variable = find_variable(data, validity_flags_name))
    if (const auto* masks = std::get_if<std::vector<std::int64_t>>(&variable->values))
      for (const std::int64_t mask : *masks) raised |= static_cast<std::uint64_t>(mask);
  return raised_notes(validity_limits(), raised, validity_sign);
}

std::string marked_line(std::size_t points, const std::vector<std::string>& marks) {
  if (marks.empty()) return "";
  return fmt::format("Marked in the table of all numbers: of {} point{} {}.\n", points,
                     points == 1 ? "" : "s", fmt::join(marks, " and "));
}

}  // namespace sim
