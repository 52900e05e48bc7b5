#include "sim/components/digitised_curve.hpp"

#include <fmt/format.h>

#include <sstream>

#include "sim/failure.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/text/number_text.hpp"
#include "sim/text/text_file.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

void add_point(DigitisedCurve& curve, const std::string& line, const std::string& place) {
  const std::size_t comma = line.find(',');
  const auto x = parse_number(line.substr(0, comma));
  const auto y = comma == std::string::npos ? x : parse_number(line.substr(comma + 1));
  if (comma == std::string::npos || !x || !y)
    throw bad_input(fmt::format("\"{}\" {}", line, place), "not two numbers", "write X,Y");
  curve.x.push_back(*x);
  curve.y.push_back(*y);
}

}  // namespace

DigitisedCurve read_digitised_curve(const fs::path& path) {
  std::istringstream text(read_text_file(path, "digitised curve"));
  std::string line;
  if (!std::getline(text, line) || !line.starts_with("# "))
    throw bad_input("in " + path.generic_string() + ":1", "the source is missing",
                    "begin with \"# document, revision, figure, units\"");
  DigitisedCurve curve{line.substr(2), {}, {}};
  std::getline(text, line);  // names of the columns
  for (int number = 3; std::getline(text, line); ++number)
    add_point(curve, line, fmt::format("in {}:{}", path.generic_string(), number));
  if (curve.x.size() < 2)
    throw bad_input("in " + path.generic_string(), "a curve has at least two points", "add points");
  return curve;
}

}  // namespace sim
