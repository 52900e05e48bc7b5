#include "sim/store.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <cassert>
#include <ctime>
#include <limits>
#include <utility>

#include "sim/failure.hpp"
#include "sim/new_file.hpp"

namespace sim {
namespace {

// The file is built in memory first, where only a lack of it can fail; then it is plain bytes.
template <class Status>
Status checked(Status status) {
  if (status >= 0) return status;
  throw Failure(ExitCode::environment,
                "cannot build the result file (HDF5 gave up: out of memory?) sweep fewer points");
}

class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(checked(id)), close_(close) {}
  Handle(Handle&& o) noexcept : id_(std::exchange(o.id_, H5I_INVALID_HID)), close_(o.close_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

class SilentErrors {
 public:
  SilentErrors() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  SilentErrors(const SilentErrors&) = delete;
  SilentErrors& operator=(const SilentErrors&) = delete;
  ~SilentErrors() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

hid_t type_of(double) { return H5T_NATIVE_DOUBLE; }
hid_t type_of(std::int16_t) { return H5T_NATIVE_INT16; }
hid_t type_of(std::int64_t) { return H5T_NATIVE_INT64; }
hid_t type_of(std::uint64_t) { return H5T_NATIVE_UINT64; }

// netCDF's own default fill values (netcdf.h), except that a missing real number is NaN.
double fill_of(double) { return std::numeric_limits<double>::quiet_NaN(); }
std::int16_t fill_of(std::int16_t) { return -32767; }
std::int64_t fill_of(std::int64_t) { return -9223372036854775806; }

void set_text(hid_t object, const char* name, const std::string& text) {
  checked(H5LTset_attribute_string(object, ".", name, text.c_str()));
}

// What the user wrote, in UTF-8 and of any length: a fixed-length attribute would end at 64 kB and
// be read as ASCII.
void set_user_text(hid_t object, const char* name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  checked(H5Tset_size(type, H5T_VARIABLE));
  checked(H5Tset_cset(type, H5T_CSET_UTF8));
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const char* const value = text.c_str();
  checked(H5Awrite(attribute, type, &value));
}

template <class T>
void set_numbers(hid_t object, const char* name, const std::vector<T>& values) {
  const hsize_t n = values.size();
  const Handle space(H5Screate_simple(1, &n, nullptr), H5Sclose);
  const hid_t type = type_of(T{});
  const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checked(H5Awrite(attribute, type, values.data()));
}

struct Target {
  const ExperimentResult& result;
  Handle file;
  Handle space;
  std::vector<Handle> scales;  // one an axis
};

Handle file_in_memory() {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  checked(H5Pset_fapl_core(access, std::size_t{1} << 20, false));
  return {H5Fcreate("result", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose};
}

Handle space_of(const std::vector<Axis>& axes) {
  std::vector<hsize_t> shape;
  for (const Axis& axis : axes) shape.push_back(axis.values.size());
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose};
}

void write_scale(Target& to, const Axis& axis) {
  std::string name = axis.key;
  std::replace(name.begin(), name.end(), '.', '_');
  const hsize_t n = axis.values.size();
  checked(H5LTmake_dataset_double(to.file, name.c_str(), 1, &n, axis.values.data()));
  const Handle& scale =
      to.scales.emplace_back(H5Dopen2(to.file, name.c_str(), H5P_DEFAULT), H5Dclose);
  checked(H5DSset_scale(scale, name.c_str()));
  set_text(scale, "units", axis.unit.empty() ? "1" : axis.unit);
  set_text(scale, "long_name", axis.long_name);
}

template <class T>
Handle dataset(const Target& to, const Column& column, const std::vector<T>& values) {
  const T fill = fill_of(T{});
  const hid_t type = type_of(T{});
  const Handle plist(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  checked(H5Pset_fill_value(plist, type, &fill));
  Handle data(H5Dcreate2(to.file, column.name, type, to.space, H5P_DEFAULT, plist, H5P_DEFAULT),
              H5Dclose);
  checked(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  set_numbers<T>(data, "_FillValue", {fill});
  return data;
}

template <class T, class Read>
Handle dataset_of(const Target& to, const Column& column, Read read) {
  std::vector<T> values;
  for (const PointResult& p : to.result.points) values.push_back(static_cast<T>(read(p)));
  return dataset(to, column, values);
}

struct ColumnWriter {
  const Target& to;
  const Column& column;

  Handle operator()(std::uint64_t Tally::*count) const {
    return dataset_of<std::int64_t>(to, column, [=](const auto& p) { return p.tally.*count; });
  }
  Handle operator()(std::uint64_t PointResult::*count) const {
    return dataset_of<std::int64_t>(to, column, [=](const auto& p) { return p.*count; });
  }
  Handle operator()(StopReason PointResult::*flag) const {
    return dataset_of<std::int16_t>(to, column, [=](const auto& p) {
      return measured(p) ? static_cast<std::int16_t>(p.*flag) : fill_of(std::int16_t{});
    });
  }
  Handle operator()(Column::Real real) const {
    const double level = to.result.ci_level;
    return dataset_of<double>(to, column, [=](const auto& p) { return real(p, level); });
  }
};

void write_column(const Target& to, const Column& column) {
  const Handle data = std::visit(ColumnWriter{to, column}, column.value);
  set_text(data, "units", column.unit);
  set_text(data, "long_name", column.long_name);
  for (unsigned i = 0; i < to.scales.size(); ++i) checked(H5DSattach_scale(data, to.scales[i], i));
}

Handle variable(const Target& in, const char* name) {
  return {H5Dopen2(in.file, name, H5P_DEFAULT), H5Dclose};
}

void explain_stop_reason(const Target& in) {
  std::vector<std::int16_t> numbers;
  for (std::int16_t i = 0; numbers.size() < stop_reason_names().size(); ++i) numbers.push_back(i);
  const Handle data = variable(in, "stop_reason");
  set_numbers(data, "flag_values", numbers);
  set_text(data, "flag_meanings", fmt::format("{}", fmt::join(stop_reason_names(), " ")));
}

// As an attribute only where it is one number; the variable snr_bandwidth_hz always has it.
void explain_snr(const Target& in) {
  const Handle data = variable(in, "snr_db");
  set_text(data, "ancillary_variables", "snr_bandwidth_hz");
  std::vector<double> bandwidths;
  for (const PointResult& p : in.result.points) {
    if (measured(p)) bandwidths.push_back(p.operating.snr_bandwidth_hz);
  }
  std::sort(bandwidths.begin(), bandwidths.end());
  bandwidths.erase(std::unique(bandwidths.begin(), bandwidths.end()), bandwidths.end());
  if (bandwidths.size() == 1) set_numbers(data, "bandwidth_hz", bandwidths);
}

std::string now_iso_8601() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

void write_root(const Target& to, const ProgramInfo& program) {
  const ExperimentResult& result = to.result;
  set_text(to.file, "Conventions", "CF-1.10");
  set_text(to.file, "filetype", "cosys-sim result");
  set_text(to.file, "format_version", "1.0");
  set_text(to.file, "program", program.name);
  set_text(to.file, "version", program.version);
  set_text(to.file, "commit", program.commit);
  set_text(to.file, "created", now_iso_8601());
  set_user_text(to.file, "title", result.title);
  set_user_text(to.file, "scenario_toml", result.scenario_toml);
  set_user_text(to.file, "command", result.command);
  set_numbers<std::uint64_t>(to.file, "seed", {result.seed});
  set_text(to.file, "result_digest", result_digest(result));
  set_numbers<double>(to.file, "ci_level", {result.ci_level});
  set_text(
      to.file, "ci_method",
      "flr, uer: Clopper-Pearson; ber: Clopper-Pearson on the effective number of bits, frames "
      "as clusters (Korn & Graubard 1998)");
}

std::string image_of(const Handle& file) {
  checked(H5Fflush(file, H5F_SCOPE_GLOBAL));
  std::string image(static_cast<std::size_t>(checked(H5Fget_file_image(file, nullptr, 0))), '\0');
  checked(H5Fget_file_image(file, image.data(), image.size()));
  return image;
}

std::string build_image(const ExperimentResult& result, const ProgramInfo& program) {
  const SilentErrors silent;
  Target to{result, file_in_memory(), space_of(result.axes), {}};
  assert(static_cast<hsize_t>(H5Sget_simple_extent_npoints(to.space)) == result.points.size());
  for (const Axis& axis : result.axes) write_scale(to, axis);
  for (const Column& column : columns()) write_column(to, column);
  explain_stop_reason(to);
  explain_snr(to);
  checked(H5LTset_attribute_string(to.file, "ebn0_db", "eb_convention", "average"));
  write_root(to, program);
  return image_of(to.file);
}

}  // namespace

void write_result(const std::filesystem::path& path, const ExperimentResult& result,
                  const ProgramInfo& program) {
  const std::string image = build_image(result, program);
  NewFile file(path);
  file.write(image);
  file.take_place();
}

void check_writable(const std::filesystem::path& path) { const NewFile file(path); }

}  // namespace sim
