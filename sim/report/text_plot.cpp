#include "sim/report/text_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sim {
namespace {

constexpr int columns = 64, rows = 15;
constexpr int label_width = 10;

/// Values along one axis, as the paper has them.
class Scale {
 public:
  Scale(const FigureAxis& axis, int cells) : logarithmic_(axis.logarithmic), cells_(cells) {}

  void cover(double value) {
    if (!shows(value)) return;
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  bool shows(double value) const { return std::isfinite(value) && (!logarithmic_ || value > 0); }
  int cell(double value) const {
    const double span = on_paper(high_) - on_paper(low_);
    const double share = span > 0 ? (on_paper(value) - on_paper(low_)) / span : 0.5;
    return static_cast<int>(std::lround(share * (cells_ - 1)));
  }
  double low() const { return low_; }
  double high() const { return high_; }

 private:
  double on_paper(double value) const { return logarithmic_ ? std::log(value) : value; }

  bool logarithmic_;
  int cells_;
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
};

class Paper {
 public:
  Paper(const Scale& x, const Scale& y)
      : x_(x), y_(y), lines_(rows, std::string(static_cast<std::size_t>(columns), ' ')) {}

  void mark(double x, double y, char with) {
    if (!x_.shows(x) || !y_.shows(y)) return;
    char& at = lines_[static_cast<std::size_t>(rows - 1 - y_.cell(y))]
                     [static_cast<std::size_t>(x_.cell(x))];
    at = at == ' ' || at == with ? with : '*';
  }
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  const Scale& x_;
  const Scale& y_;
  std::vector<std::string> lines_;
};

std::string label(const FigureAxis& axis) {
  return fmt::format("{}{}{}", axis.name, axis.unit == "1" ? "" : " [" + axis.unit + "]",
                     axis.logarithmic ? ", logarithmic" : "");
}

std::string framed(const Paper& paper, const Scale& x, const Scale& y, const FigureAxis& axis) {
  std::string text;
  for (std::size_t i = 0; i < paper.lines().size(); ++i) {
    const bool top = i == 0, bottom = i + 1 == paper.lines().size();
    const std::string edge = top      ? fmt::format("{:.4g}", y.high())
                             : bottom ? fmt::format("{:.4g}", y.low())
                                      : "";
    std::string line = fmt::format("{:>{}} |{}", edge, label_width, paper.lines()[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  text += fmt::format("{:>{}} +{:-<{}}\n", "", label_width, "", columns);
  text += fmt::format("{:>{}}  {:<{}.4g}{:^{}}{:>{}.4g}\n", "", label_width, x.low(), 10,
                      label(axis), columns - 20, x.high(), 10);
  return text;
}

}  // namespace

std::string text_plot(const FigureAxis& x, const FigureAxis& y, const PlottedCurves& curves) {
  Scale across(x, columns), up(y, rows);
  for (const double value : curves.x) across.cover(value);
  for (const auto* values : {&curves.sheet, &curves.model})
    for (const double value : *values) up.cover(value);
  Paper paper(across, up);
  for (std::size_t i = 0; i < curves.x.size(); ++i) {
    paper.mark(curves.x[i], curves.sheet[i], 'o');
    paper.mark(curves.x[i], curves.model[i], 'x');
  }
  return fmt::format("{:>{}}  {}; o data sheet, x model, * both\n", "", label_width, label(y)) +
         framed(paper, across, up, x);
}

}  // namespace sim
