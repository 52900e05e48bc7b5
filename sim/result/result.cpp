#include "sim/result/result.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "sim/counting/statistics.hpp"
#include "sim/result/point_loss.hpp"
#include "sim/text/digest.hpp"

namespace sim {
namespace {

using Ratio = Estimate (*)(const Tally&, double);

template <Ratio ratio_of, double Estimate::*member>
double rate(const PointResult& p, double ci_level) {
  return ratio_of(p.tally, ci_level).*member;
}

template <double Estimate::*member>
double loss(const PointResult& p, double ci_level) {
  return frame_loss_of(p, ci_level).*member;
}

template <double OperatingPoint::*member>
double operating(const PointResult& p, double) {
  return measured(p) ? p.operating.*member : std::numeric_limits<double>::quiet_NaN();
}

template <double PointResult::*member>
double cost(const PointResult& p, double) {
  return p.*member;
}

template <WeightedSum Weighted::*sum>
double cov(const PointResult& p, double) {
  const Weighted& weighted = p.tally.weighted;
  return (weighted.*sum).coefficient_of_variation(weighted.n_groups);
}

template <WeightedSum Weighted::*sum>
double ess(const PointResult& p, double) {
  return (p.tally.weighted.*sum).effective_size();
}

double& groups(Weighted& weighted) { return weighted.n_groups; }
double& dark_likelihood(Weighted& weighted) { return weighted.dark_likelihood; }

template <WeightedSum Weighted::*sum, double WeightedSum::*part>
double& sum_of(Weighted& weighted) {
  return weighted.*sum.*part;
}

constexpr const char* ber_low = "lower end of the interval of ber";
constexpr const char* ber_high = "upper end of the interval of ber";
constexpr const char* flr_low = "lower end of the interval of flr";
constexpr const char* flr_high = "upper end of the interval of flr";
constexpr const char* uer_low = "lower end of the interval of uer";
constexpr const char* uer_high = "upper end of the interval of uer";

const std::array column_table{
    LinkColumn{"n_bits", "1", "line bits sent", &Tally::n_bits},
    LinkColumn{"n_bit_errors", "1",
               "line bits wrong at the centre of their slot, before any decoder",
               &Tally::n_bit_errors},
    LinkColumn{"ber", "1", "bit error ratio", rate<bit_error_ratio, &Estimate::value>},
    LinkColumn{"ber_ci_low", "1", ber_low, rate<bit_error_ratio, &Estimate::low>},
    LinkColumn{"ber_ci_high", "1", ber_high, rate<bit_error_ratio, &Estimate::high>},
    LinkColumn{"n_bytes", "1", "characters sent", &Tally::n_bytes},
    LinkColumn{"n_byte_errors", "1", "characters not received, or received as another",
               &Tally::n_byte_errors},
    LinkColumn{"n_framing_errors", "1",
               "characters received within the message with a bad stop bit",
               &Tally::n_framing_errors},
    LinkColumn{"n_frames", "1", "frames sent", &Tally::n_frames},
    LinkColumn{"n_frames_ok", "1", "frames delivered intact", &Tally::n_frames_ok},
    LinkColumn{"n_frames_lost", "1", "frames not delivered intact", &Tally::n_frames_lost},
    LinkColumn{"n_frames_undetected", "1", "frames that passed the checksum but were wrong",
               &Tally::n_frames_undetected},
    LinkColumn{"n_frames_false", "1", "frames accepted though none was sent",
               &Tally::n_frames_false},
    LinkColumn{"flr", "1", "frame loss ratio", rate<frame_loss_ratio, &Estimate::value>},
    LinkColumn{"flr_ci_low", "1", flr_low, loss<&Estimate::low>},
    LinkColumn{"flr_ci_high", "1", flr_high, loss<&Estimate::high>},
    LinkColumn{"uer", "1", "undetected frame error ratio",
               rate<undetected_error_ratio, &Estimate::value>},
    LinkColumn{"uer_ci_low", "1", uer_low, rate<undetected_error_ratio, &Estimate::low>},
    LinkColumn{"uer_ci_high", "1", uer_high, rate<undetected_error_ratio, &Estimate::high>},
    LinkColumn{"n_frames_unheard", "1", "frames lost: no character received",
               &Tally::n_frames_unheard},
    LinkColumn{"n_frames_unended", "1", "frames lost: characters received, but no line ended",
               &Tally::n_frames_unended},
    LinkColumn{"n_rejected_unprintable", "1", "lines rejected: unprintable character",
               &Tally::n_rejected_unprintable},
    LinkColumn{"n_rejected_short", "1", "lines rejected: too short", &Tally::n_rejected_short},
    LinkColumn{"n_rejected_not_hex", "1", "lines rejected: checksum not hexadecimal",
               &Tally::n_rejected_not_hex},
    LinkColumn{"n_rejected_checksum", "1", "lines rejected: wrong checksum",
               &Tally::n_rejected_checksum},
    LinkColumn{"n_rejected_overlong", "1", "lines rejected: too long", &Tally::n_rejected_overlong},
    LinkColumn{"n_frames_bit_errors", "1", "frames with a bit error", &Tally::n_frames_bit_errors},
    LinkColumn{"sum_bit_errors_squared", "1", "sum over frames of squared bit errors",
               &Tally::sum_bit_errors_squared},
    LinkColumn{"sum_bits_squared", "1", "sum over frames of squared bits",
               &Tally::sum_bits_squared},
    LinkColumn{"sum_bit_errors_times_bits", "1", "sum over frames of bit errors times bits",
               &Tally::sum_bit_errors_times_bits},
    LinkColumn{"irradiance_mw_per_m2", "mW m-2", "effective irradiance at the module, carrier on",
               operating<&OperatingPoint::irradiance_mw_per_m2>},
    LinkColumn{"ambient_w_per_m2", "W m-2", "ambient irradiance at the module",
               operating<&OperatingPoint::ambient_w_per_m2>},
    LinkColumn{"snr_db", "dB", "signal-to-noise ratio behind the band-pass",
               operating<&OperatingPoint::snr_db>},
    LinkColumn{"snr_bandwidth_hz", "Hz", "noise bandwidth of snr_db",
               operating<&OperatingPoint::snr_bandwidth_hz>},
    LinkColumn{"ebn0_db", "dB", "energy per bit over noise density",
               operating<&OperatingPoint::ebn0_db>},
    LinkColumn{"ber_theory", "1", "bit error ratio of a matched receiver in theory",
               operating<&OperatingPoint::ber_theory>},
    LinkColumn{"ber_sampled", "1", "the same of the samples of its waveform",
               operating<&OperatingPoint::ber_sampled>},
    LinkColumn{"outside_validity", "1", "limits of the models' validity that the point leaves",
               &PointResult::validity_flags},
    LinkColumn{"alarms", "1", "why the counts are to be distrusted", &PointResult::alarms},
    LinkColumn{"stop_reason", "1", "why the point stopped", &PointResult::stop},
    LinkColumn{"elapsed_s", "s", "wall-clock time", cost<&PointResult::elapsed_s>},
    LinkColumn{"simulated_s", "s", "simulated time of the link", cost<&PointResult::simulated_s>},
    LinkColumn{"n_samples", "1", "waveform samples simulated", &PointResult::n_samples},
    LinkColumn{"ber_cov", "1", "coefficient of variation of ber", cov<&Weighted::bit_errors>, true},
    LinkColumn{"ber_ess", "1", "effective sample size of ber", ess<&Weighted::bit_errors>, true},
    LinkColumn{"flr_cov", "1", "coefficient of variation of flr", cov<&Weighted::frames_lost>,
               true},
    LinkColumn{"flr_ess", "1", "effective sample size of flr", ess<&Weighted::frames_lost>, true},
    LinkColumn{"n_groups", "1", "groups of frames drawn together", groups, true},
    LinkColumn{"sum_weighted_bit_errors", "1", "sum over runs of bit errors, weighted",
               sum_of<&Weighted::bit_errors, &WeightedSum::sum>, true},
    LinkColumn{"sum_weighted_bit_errors_squared", "1", "sum over runs of their squares",
               sum_of<&Weighted::bit_errors, &WeightedSum::squares>, true},
    LinkColumn{"sum_group_bit_errors_squared", "1", "sum over groups of the squared sum in each",
               sum_of<&Weighted::bit_errors, &WeightedSum::group_squares>, true},
    LinkColumn{"max_weighted_bit_errors", "1", "the largest of the runs",
               sum_of<&Weighted::bit_errors, &WeightedSum::largest>, true},
    LinkColumn{"sum_weighted_frames_lost", "1", "sum over runs of frames lost, weighted",
               sum_of<&Weighted::frames_lost, &WeightedSum::sum>, true},
    LinkColumn{"sum_weighted_frames_lost_squared", "1", "sum over runs of their squares",
               sum_of<&Weighted::frames_lost, &WeightedSum::squares>, true},
    LinkColumn{"sum_group_frames_lost_squared", "1", "sum over groups of the squared sum in each",
               sum_of<&Weighted::frames_lost, &WeightedSum::group_squares>, true},
    LinkColumn{"max_weighted_frames_lost", "1", "the largest of the runs",
               sum_of<&Weighted::frames_lost, &WeightedSum::largest>, true},
    LinkColumn{"sum_dark_likelihood", "1",
               "sum over frames of about the probability of light in a dark bit", dark_likelihood,
               true},
};

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

void append_point(std::string& bytes, const PointResult& p) {
  append(bytes, p.coordinates.size());
  for (const double c : p.coordinates) append(bytes, std::bit_cast<std::uint64_t>(c));
  for (const LinkColumn& column : column_table) {
    const auto* counter = std::get_if<std::uint64_t Tally::*>(&column.value);
    if (counter) append(bytes, p.tally.**counter);
  }
  if (!p.tally.is_weighted()) return;
  Weighted weighted = p.tally.weighted;
  for (const LinkColumn& column : column_table) {
    const auto* sum = std::get_if<LinkColumn::Sum>(&column.value);
    if (sum) append(bytes, std::bit_cast<std::uint64_t>((*sum)(weighted)));
  }
}

}  // namespace

std::span<const LinkColumn> columns() { return column_table; }

bool measured(const PointResult& point) { return point.tally.n_frames > 0; }

bool is_weighted(const ExperimentResult& result) {
  return std::ranges::any_of(result.points,
                             [](const PointResult& p) { return p.tally.is_weighted(); });
}

std::vector<const LinkColumn*> columns_of(const ExperimentResult& result) {
  const bool weighted = is_weighted(result);
  std::vector<const LinkColumn*> all;
  for (const LinkColumn& column : column_table)
    if (weighted || !column.weighted) all.push_back(&column);
  return all;
}

std::string result_digest(const ExperimentResult& result) {
  std::string bytes;
  for (const Axis& axis : result.axes) append_labels(bytes, axis);
  for (const PointResult& p : result.points) append_point(bytes, p);
  return digest_of(bytes);
}

}  // namespace sim
