#include "sim/section/point_marks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sim {

std::string marked_line(std::size_t points, const std::vector<std::string>& marks) {
  if (marks.empty()) return "";
  return fmt::format("Marked in the table of all numbers: of {} point{} {}.\n", points,
                     points == 1 ? "" : "s", fmt::join(marks, " and "));
}

}  // namespace sim
