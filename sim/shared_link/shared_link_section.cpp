#include "sim/shared_link/shared_link_section.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

#include "sim/section/curve_span.hpp"
#include "sim/section/dataset_cells.hpp"
#include "sim/section/dataset_shares.hpp"
#include "sim/section/dataset_words.hpp"
#include "sim/section/experiment_section.hpp"
#include "sim/section/picture_sections.hpp"
#include "sim/shared_link/shared_link_report.hpp"

namespace sim {
namespace {

std::string size_of(const Dataset& data) {
  const double sent = DatasetCells(data, "n_messages").sum();
  const double accepted = DatasetCells(data, "n_accepted").sum();
  return fmt::format(
      "Both nodes together sent {:.0f} messages in {}; {:.0f} of them the other did not accept.\n",
      sent, runs_text(data), sent - accepted);
}

constexpr double half = 0.5;

/// Of each curve the longest stretch at which half of the messages or more are lost.
std::vector<CurveSpan> half_lost_spans(const std::vector<ChartCurve>& curves) {
  std::vector<CurveSpan> spans;
  for (const ChartCurve& curve : curves)
    if (const auto span = longest_span(curve, half)) spans.push_back(*span);
  return spans;
}

/// Where all curves have the same stretch it is said once.
std::string half_lost(const Chart& chart, const Axis& x) {
  std::vector<CurveSpan> spans = half_lost_spans(chart.curves);
  if (spans.empty()) return "At no point that was measured is half of the messages lost.\n";
  const bool are_alike = std::ranges::all_of(spans, [&](const CurveSpan& span) {
    return span.from == spans.front().from && span.to == spans.front().to;
  });
  if (are_alike && spans.size() == chart.curves.size()) {
    spans.resize(1);
    spans.front().curve.clear();
  }
  std::vector<std::string> where;
  for (const CurveSpan& span : spans) where.push_back(in_words(span, x));
  return fmt::format("Half of a node's messages or more are lost at {}.\n",
                     fmt::join(where, "; at "));
}

/// "1.7 to 1.8 s (sender A)": the mean ages of a curve where most messages are heard; empty where
/// there are none.
std::string ages_where_heard(const ChartCurve& loss, const ChartCurve& age) {
  std::vector<double> ages;
  for (const ChartPoint& point : age.points) {
    const auto lost = std::ranges::find(loss.points, point.x, &ChartPoint::x);
    if (std::isfinite(point.y) && lost != loss.points.end() && lost->y < half)
      ages.push_back(point.y);
  }
  if (ages.empty()) return "";
  const auto [least, most] = std::ranges::minmax(ages);
  const std::string from = fmt::format("{:.2g}", least), to = fmt::format("{:.2g}", most);
  const std::string span = from == to ? from + " s" : from + " to " + to + " s";
  return age.name.empty() ? span : span + " (" + age.name + ")";
}

std::string freshness(const Chart& loss, const Chart& age) {
  std::vector<std::string> spans;
  for (const ChartCurve& curve : age.curves) {
    const auto lost = std::ranges::find(loss.curves, curve.name, &ChartCurve::name);
    if (lost == loss.curves.end()) continue;
    const std::string span = ages_where_heard(*lost, curve);
    if (!span.empty()) spans.push_back(span);
  }
  if (spans.empty()) return "";
  return fmt::format(
      "Where more than half of them are heard, its values are so old at the other on average: "
      "{}.\n",
      fmt::join(spans, "; "));
}

/// Of a single point what becomes of each node's messages.
std::string directions(const Dataset& data) {
  std::string text;
  if (!data.axes.empty()) return text;
  const DatasetCells loss(data, "message_loss"), age(data, "age_mean_s"), old(data, "age_p95_s");
  const Dataset::Dimension& senders = dimension_named(data, "sender");
  for (std::size_t i = 0; i < std::min(loss.size(), senders.size()); ++i)
    text += fmt::format(
        "Of {}'s messages {} are lost; {}.\n", value_text(senders, i), loss.text(i),
        std::isnan(age[i])
            ? "nothing of it was ever known to the other node"
            : fmt::format("its values are {} s old at the other node on average, and {} s or less "
                          "for 95 % of the time",
                          age.text(i), old.text(i)));
  return text;
}

/// Reasons by how often they were given, the commonest first.
std::vector<std::size_t> reasons_by_count(const DatasetCells& refused, std::size_t reasons) {
  std::vector<double> counts(reasons);
  for (std::size_t i = 0; i < refused.size(); ++i)
    counts[i % reasons] += static_cast<double>(refused.count(i));
  std::vector<std::size_t> order(reasons);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return counts[i]; });
  return order;
}

/// How many messages each point has of each kind: accepted, the commonest reasons,
/// all others together, and those of which nothing was noticed.
class RefusalCounts {
 public:
  static constexpr std::size_t most_reasons = 6;

  explicit RefusalCounts(const Dataset& data)
      : reasons_(dimension_named(data, "reason")),
        senders_(dimension_named(data, "sender").size()),
        sent_(data, "n_messages"),
        accepted_(data, "n_accepted"),
        refused_(data, "n_rejected"),
        order_(reasons_by_count(refused_, reasons_.size())) {}

  std::vector<std::string> kinds() const {
    std::vector<std::string> words{"accepted"};
    for (std::size_t k = 0; k < named(); ++k)
      words.push_back("refused: " + plain_words(value_text(reasons_, order_[k])));
    words.emplace_back("refused for another reason");
    words.emplace_back("not noticed");
    return words;
  }
  /// Of all senders of a point.
  std::vector<std::uint64_t> operator()(std::size_t point) const {
    std::vector<std::uint64_t> counts(named() + 3);
    for (std::size_t sender = 0; sender < senders_; ++sender)
      add(counts, point * senders_ + sender);
    return counts;
  }

 private:
  void add(std::vector<std::uint64_t>& counts, std::size_t cell) const {
    std::uint64_t noticed = accepted_.count(cell);
    counts[0] += noticed;
    for (std::size_t k = 0; k < order_.size(); ++k) {
      const std::uint64_t refused = refused_.count(cell * order_.size() + order_[k]);
      counts[std::min(k, named()) + 1] += refused;
      noticed += refused;
    }
    const std::uint64_t sent = sent_.count(cell);
    counts.back() += sent > noticed ? sent - noticed : 0;  // of one, two pieces may be refused
  }
  std::size_t named() const { return std::min(most_reasons, order_.size()); }

  const Dataset::Dimension& reasons_;
  std::size_t senders_;
  DatasetCells sent_, accepted_, refused_;
  std::vector<std::size_t> order_;
};

ShareBars refusals(const Dataset& data) {
  const RefusalCounts counts(data);
  return point_shares(data, "What the other node made of the messages",
                      "messages accepted, and refused by their reasons, of both nodes",
                      counts.kinds(), counts);
}

void add_charts(ReportSection& report, const Dataset& data) {
  const std::optional<Chart> loss = swept_chart(
                                 data, drawn_column(shared_link_columns(), "message_loss")),
                             age = swept_chart(data,
                                               drawn_column(shared_link_columns(), "age_mean_s"));
  if (loss) report.summary += half_lost(*loss, *widest_axis(data));
  if (loss && age) report.summary += freshness(*loss, *age);
  add_chart(report, loss);
  add_chart(report, age);
}

}  // namespace

ReportSection shared_link_section(const std::string& name, const StoredDataset& stored) {
  const Dataset& data = stored.data;
  ReportSection report{name, data.title, size_of(data) + directions(data)};
  add_charts(report, data);
  report.summary += missing_points(stored);
  if (find_variable(data, "n_rejected") != nullptr)
    report.sections.push_back(shares_section("refusals", refusals(data)));
  add_closing(report, data,
              headed_columns(data, shared_link_columns().facts(),
                             {"n_messages", "n_accepted", "message_loss", "ber", "age_mean_s",
                              "age_p95_s", "unknown_share", "n_queries", "n_queries_answered",
                              "n_queries_timed_out", "n_own_messages"}));
  return report;
}

}  // namespace sim
