#include "sim/exchange/exchange_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>

#include "sim/page/dataset_cells.hpp"
#include "sim/page/dataset_words.hpp"
#include "sim/page/experiment_part.hpp"
#include "sim/page/picture_sections.hpp"
#include "sim/report/swept_rows.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {
namespace {

std::string size_of(const Dataset& data) {
  const double sent = DatasetCells(data, "n_messages").sum();
  const double accepted = DatasetCells(data, "n_accepted").sum();
  const std::size_t points = measured_points(data).size();
  return fmt::format(
      "Both nodes together sent {:.0f} messages in {} runs{}; {:.0f} of them the other did not "
      "accept.\n",
      sent, data.n_runs, points > 1 ? fmt::format(" at {} points", points) : "", sent - accepted);
}

/// Where half of the messages or more are lost.
std::string half_lost(const Chart& chart) {
  constexpr double half = 0.5;
  std::optional<double> from, to;
  for (const ChartCurve& curve : chart.curves)
    for (const ChartPoint& point : curve.points) {
      if (point.y < half) continue;
      from = std::min(from.value_or(point.x), point.x);
      to = std::max(to.value_or(point.x), point.x);
    }
  if (!from) return "Nowhere is half of the messages lost.\n";
  return fmt::format("Half of a node's messages or more are lost at {} from {:g} to {:g}.\n",
                     chart.x.label, *from, *to);
}

/// Of a single point what becomes of each node's messages.
std::string directions(const Dataset& data) {
  std::string text;
  if (!data.axes.empty()) return text;
  const DatasetCells loss(data, "message_loss"), age(data, "age_mean_s"), old(data, "age_p95_s");
  for (std::size_t i = 0; i < loss.size(); ++i)
    text += fmt::format(
        "Of {}'s messages {} are lost; its values are {} s old at the other node on average, and "
        "{} s or less for 95 % of the time.\n",
        value_text(dimension_named(data, "sender"), i), loss.text(i), age.text(i), old.text(i));
  return text;
}

/// Reasons by how often they were given, the commonest first.
std::vector<std::size_t> reasons_by_count(const DatasetCells& refused, std::size_t reasons) {
  std::vector<double> counts(reasons);
  for (std::size_t i = 0; i < refused.size(); ++i) counts[i % reasons] += refused[i];
  std::vector<std::size_t> order(reasons);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return counts[i]; });
  return order;
}

/// How many messages a cell's point and sender have of each kind: accepted, the commonest reasons,
/// all others together, and those of which nothing was noticed.
class RefusalCounts {
 public:
  static constexpr std::size_t most_reasons = 6;

  explicit RefusalCounts(const Dataset& data)
      : reasons_(dimension_named(data, "reason")),
        sent_(data, "n_messages"),
        accepted_(data, "n_accepted"),
        refused_(data, "n_rejected"),
        order_(reasons_by_count(refused_, reasons_.size())) {}

  std::vector<std::string> kinds() const {
    std::vector<std::string> words{"accepted"};
    for (std::size_t k = 0; k < named(); ++k)
      words.push_back("refused: " + value_text(reasons_, order_[k]));
    words.emplace_back("refused for another reason");
    words.emplace_back("not noticed");
    return words;
  }
  std::size_t cells() const { return accepted_.size(); }
  std::vector<std::uint64_t> operator()(std::size_t cell) const {
    std::vector<std::uint64_t> counts(named() + 3);
    counts[0] = static_cast<std::uint64_t>(accepted_[cell]);
    for (std::size_t k = 0; k < order_.size(); ++k)
      counts[std::min(k, named()) + 1] +=
          static_cast<std::uint64_t>(refused_[cell * order_.size() + order_[k]]);
    const auto noticed = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    const auto sent = static_cast<std::uint64_t>(sent_[cell]);
    counts.back() = sent > noticed ? sent - noticed : 0;  // of one, two pieces may be refused
    return counts;
  }

 private:
  std::size_t named() const { return std::min(most_reasons, order_.size()); }

  const Dataset::Dimension& reasons_;
  DatasetCells sent_, accepted_, refused_;
  std::vector<std::size_t> order_;
};

ShareBars refusals(const Dataset& data) {
  constexpr std::size_t senders = 2;
  const SweptRows rows(data.axes);
  const RefusalCounts counts(data);
  ShareBars bars{.title = "What the other node made of the messages",
                 .description = "Messages accepted, and refused by their reasons, of both nodes",
                 .rows_label = rows.head(),
                 .kinds = counts.kinds(),
                 .rows = {}};
  for (std::size_t i = 0; i < counts.cells(); ++i)
    add_counts(bars, rows.label(point_coordinates(data.axes, i / senders)), counts(i));
  return bars;
}

void add_charts(ReportPart& part, const Dataset& data) {
  const std::optional<Chart> loss = swept_chart(data, {.name = "message_loss",
                                                       .title = "Message loss",
                                                       .label = "message loss ratio",
                                                       .logarithmic = true});
  if (loss) part.verdict += half_lost(*loss);
  add_chart(part, loss);
  add_chart(part, swept_chart(data, {.name = "age_mean_s",
                                     .title = "Age of values at the other node",
                                     .label = "mean age [s]"}));
}

std::vector<DatasetColumn> columns() {
  return {{"n_messages", "messages"},
          {"n_accepted", "accepted"},
          {"message_loss", "message loss"},
          {"ber", "BER"},
          {"age_mean_s", "mean age [s]"},
          {"age_p95_s", "95 % of ages [s]"},
          {"unknown_share", "nothing known"},
          {"n_queries", "questions"},
          {"n_queries_answered", "answered"},
          {"n_queries_timed_out", "timed out"},
          {"n_own_messages", "own messages heard"}};
}

}  // namespace

ReportPart exchange_part(const std::string& name, const StoredDataset& stored) {
  const Dataset& data = stored.data;
  ReportPart part{name, data.title, size_of(data) + directions(data)};
  add_charts(part, data);
  part.verdict += missing_points(data);
  if (find_variable(data, "n_rejected") != nullptr)
    part.sections.push_back(shares_section("refusals", refusals(data)));
  add_closing(part, data, columns());
  return part;
}

}  // namespace sim
