#include "sim/section/page_section.hpp"

#include <cctype>
#include <utility>

namespace sim {

std::string picture_name(const std::string& title) {
  std::string name;
  for (const char c : title) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0)
      name += static_cast<char>(std::tolower(byte));
    else if (!name.ends_with('-'))
      name += '-';
  }
  return name;
}

PagePicture picture_of(Chart chart) {
  std::string svg = chart_as_svg(chart);
  return {picture_name(chart.title), chart.description, std::move(svg), std::move(chart)};
}

}  // namespace sim
