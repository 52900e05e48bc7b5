#include "sim/result/store.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/link/validity.hpp"
#include "sim/result/alarms.hpp"
#include "sim/result/netcdf.hpp"
#include "sim/result/netcdf_reader.hpp"
#include "sim/scenario/flags.hpp"
#include "sim/text/new_file.hpp"

namespace sim {
namespace {

constexpr const char* store_root = NetcdfFile::root;

struct Target {
  const ExperimentResult& result;
  NetcdfFile file;
  std::vector<std::string> dimensions;  // one an axis
};

void write_axis(Target& to, const Axis& axis) {
  const std::string name = dimension_name(axis.key);
  const VariableFacts facts{name, axis.unit, axis.long_name};
  if (axis.is_text())
    to.file.add_dimension(facts, std::span<const std::string>(axis.labels));
  else
    to.file.add_dimension(facts, std::span<const double>(axis.values));
  to.dimensions.push_back(name);
}

struct ColumnWriter {
  Target& to;
  const LinkColumn& column;

  void operator()(std::uint64_t Tally::*count) const {
    write<std::int64_t>([=](const PointResult& p) { return p.tally.*count; });
  }
  void operator()(std::uint64_t PointResult::*count) const {
    write<std::int64_t>([=](const PointResult& p) { return p.*count; });
  }
  void operator()(StopReason PointResult::*flag) const {
    write<std::int16_t>([=](const PointResult& p) {
      return measured(p) ? static_cast<std::int16_t>(p.*flag) : missing_int16;
    });
  }
  void operator()(LinkColumn::Sum sum) const {
    write<double>([=](PointResult p) { return sum(p.tally.weighted); });
  }
  void operator()(LinkColumn::Real real) const {
    const double level = to.result.ci_level;
    write<double>([=](const PointResult& p) { return real(p, level); });
  }

 private:
  template <class T, class Read>
  void write(Read read) const {
    std::vector<T> values;
    for (const PointResult& p : to.result.points) values.push_back(static_cast<T>(read(p)));
    to.file.add_variable({column.name, column.unit, column.long_name}, to.dimensions,
                         std::span<const T>(values));
  }
};

void explain_stop_reason(NetcdfFile& file) {
  std::vector<std::int16_t> numbers;
  for (std::int16_t i = 0; numbers.size() < stop_reason_names().size(); ++i) numbers.push_back(i);
  file.set_numbers("stop_reason", "flag_values", std::span<const std::int16_t>(numbers));
  file.set_text("stop_reason", "flag_meanings",
                fmt::format("{}", fmt::join(stop_reason_names(), " ")));
}

// As an attribute only where it is one number; the variable snr_bandwidth_hz always has it.
void explain_snr(Target& in) {
  in.file.set_text("snr_db", "ancillary_variables", "snr_bandwidth_hz");
  std::vector<double> bandwidths;
  for (const PointResult& p : in.result.points) {
    if (measured(p)) bandwidths.push_back(p.operating.snr_bandwidth_hz);
  }
  std::sort(bandwidths.begin(), bandwidths.end());
  bandwidths.erase(std::unique(bandwidths.begin(), bandwidths.end()), bandwidths.end());
  if (bandwidths.size() == 1)
    in.file.set_numbers("snr_db", "bandwidth_hz", std::span<const double>(bandwidths));
}

std::string interval_methods(bool weighted) {
  std::string counted =
      "flr, uer: Clopper-Pearson; ber: Clopper-Pearson on the effective number of bits, frames as "
      "clusters (Korn & Graubard 1998)";
  if (!weighted) return counted;
  return "where n_groups > 0, ber and flr: log-normal, by Student's t for so many groups; "
         "elsewhere " +
         counted;
}

void write_root(Target& to) {
  const ExperimentResult& result = to.result;
  to.file.set_user_text(store_root, "title", result.title);
  to.file.set_user_text(store_root, "scenario_toml", result.scenario_toml);
  to.file.set_user_text(store_root, "command", result.command);
  to.file.set_numbers(store_root, "seed", std::span<const std::uint64_t>(&result.seed, 1));
  to.file.set_text(store_root, "shards", shards_text(result.shards));
  to.file.set_text(store_root, "result_digest", result_digest(result));
  to.file.set_numbers(store_root, "ci_level", std::span<const double>(&result.ci_level, 1));
  to.file.set_text(store_root, "ci_method", interval_methods(is_weighted(result)));
}

std::string build_image(const ExperimentResult& result, const ProgramInfo& program) {
  Target to{result, NetcdfFile(link_result_type, program), {}};
  for (const Axis& axis : result.axes) write_axis(to, axis);
  for (const LinkColumn* column : columns_of(result))
    std::visit(ColumnWriter{to, *column}, column->value);
  explain_stop_reason(to.file);
  to.file.set_flags("outside_validity", flag_names(validity_limits()));
  to.file.set_flags("alarms", flag_names(alarms()));
  explain_snr(to);
  to.file.set_text("ebn0_db", "eb_convention", "average");
  write_root(to);
  return to.file.image();
}

}  // namespace

void write_result(const std::filesystem::path& path, const ExperimentResult& result,
                  const ProgramInfo& program) {
  write_file(path, build_image(result, program));
}

void check_writable(const std::filesystem::path& path) {
  check_place(path, {is_result_of_run, "a result of cosys-sim"});
}

}  // namespace sim
