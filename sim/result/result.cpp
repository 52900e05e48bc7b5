#include "sim/result/result.hpp"

#include <algorithm>
#include <bit>

#include "sim/counting/tally_counters.hpp"
#include "sim/text/digest.hpp"

namespace sim {
namespace {

// Little-endian whatever the machine, so that digests compare between machines.
void append(std::string& bytes, std::uint64_t word) {
  for (int shift = 0; shift < 64; shift += 8) bytes += static_cast<char>((word >> shift) & 0xff);
}

void append_labels(std::string& bytes, const Axis& axis) {
  for (const std::string& label : axis.labels) {
    append(bytes, label.size());
    bytes += label;
  }
}

void append_point(std::string& bytes, const LinkPoint& p) {
  append(bytes, p.coordinates.size());
  for (const double c : p.coordinates) append(bytes, std::bit_cast<std::uint64_t>(c));
  for (const TallyCounter& counter : tally_counters()) append(bytes, p.tally.*counter.count);
  if (!p.tally.is_weighted()) return;
  Weighted weighted = p.tally.weighted;
  for (const WeightCounter& counter : weight_counters())
    append(bytes, std::bit_cast<std::uint64_t>(counter.sum(weighted)));
}

}  // namespace

bool is_weighted(const std::vector<LinkPoint>& points) {
  return std::ranges::any_of(points, [](const LinkPoint& p) { return p.tally.is_weighted(); });
}

bool is_weighted(const LinkResult& result) { return is_weighted(result.points); }

std::string result_digest(const std::vector<Axis>& axes, const std::vector<LinkPoint>& points) {
  std::string bytes;
  for (const Axis& axis : axes) append_labels(bytes, axis);
  for (const LinkPoint& p : points) append_point(bytes, p);
  return digest_of(bytes);
}

std::string result_digest(const LinkResult& result) {
  return result_digest(result.axes, result.points);
}

}  // namespace sim
