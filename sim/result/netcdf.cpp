#include "sim/result/netcdf.hpp"

#include <fmt/chrono.h>
#include <fmt/ranges.h>
#include <hdf5_hl.h>

#include <cassert>
#include <ctime>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "sim/result/hdf5_handle.hpp"

namespace sim {
namespace {

hid_t type_of(double) { return H5T_NATIVE_DOUBLE; }
hid_t type_of(float) { return H5T_NATIVE_FLOAT; }
hid_t type_of(std::int16_t) { return H5T_NATIVE_INT16; }
hid_t type_of(std::int64_t) { return H5T_NATIVE_INT64; }
hid_t type_of(std::uint64_t) { return H5T_NATIVE_UINT64; }
hid_t type_of(std::uint8_t) { return H5T_NATIVE_UINT8; }

// netCDF's own default fill values (netcdf.h), except that a missing real number is NaN, and that
// all values of a byte are taken.
std::optional<double> fill_of(double) { return std::numeric_limits<double>::quiet_NaN(); }
std::optional<float> fill_of(float) { return std::numeric_limits<float>::quiet_NaN(); }
std::optional<std::int16_t> fill_of(std::int16_t) { return missing_int16; }
std::optional<std::int64_t> fill_of(std::int64_t) { return -9223372036854775806; }
std::optional<std::uint64_t> fill_of(std::uint64_t) { return 18446744073709551614U; }
std::optional<std::uint8_t> fill_of(std::uint8_t) { return std::nullopt; }

constexpr hsize_t chunk = 1 << 16;  // cells; shorter variables are neither chunked nor compressed
constexpr unsigned gzip_level = 1;  // higher ones take several times as long and save a tenth

Handle file_in_memory() {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  checked(H5Pset_fapl_core(access, std::size_t{1} << 20, false));
  return {H5Fcreate("file", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose};
}

Handle space_of(const std::vector<hsize_t>& shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose};
}

void write_attribute(hid_t object, const char* name, hid_t type, hid_t space, const void* value) {
  const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checked(H5Awrite(attribute, type, value));
}

template <class T>
void write_numbers(hid_t object, const char* name, std::span<const T> values) {
  write_attribute(object, name, type_of(T{}), space_of({values.size()}), values.data());
}

void compress(const Handle& plist) {
  checked(H5Pset_chunk(plist, 1, &chunk));
  checked(H5Pset_shuffle(plist));
  checked(H5Pset_deflate(plist, gzip_level));
}

template <class T>
Handle write_dataset(hid_t file, const std::string& name, const std::vector<hsize_t>& shape,
                     std::span<const T> values, std::optional<T> fill) {
  const hid_t type = type_of(T{});
  const Handle space = space_of(shape);
  assert(H5Sget_simple_extent_npoints(space) == static_cast<hssize_t>(values.size()));
  const Handle plist(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (fill) checked(H5Pset_fill_value(plist, type, &*fill));
  if (shape.size() == 1 && shape[0] >= chunk) compress(plist);
  Handle data(H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, plist, H5P_DEFAULT),
              H5Dclose);
  checked(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  if (fill) write_numbers<T>(data, "_FillValue", {&*fill, 1});
  return data;
}

/// Text of any length, UTF-8.
Handle user_text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  checked(H5Tset_size(type, H5T_VARIABLE));
  checked(H5Tset_cset(type, H5T_CSET_UTF8));
  return type;
}

std::string now_iso_8601() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

void describe(hid_t data, const VariableFacts& facts) {
  const std::string unit = facts.unit.empty() ? "1" : facts.unit;
  checked(H5LTset_attribute_string(data, ".", "units", unit.c_str()));
  checked(H5LTset_attribute_string(data, ".", "long_name", facts.long_name.c_str()));
}

std::string words(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, " "));
}

}  // namespace

struct NetcdfFile::State {
  struct Dimension {
    hsize_t size;
    Handle scale;
  };

  SilentErrors silent;
  Handle file = file_in_memory();
  std::map<std::string, Dimension> dimensions;

  Handle object(const std::string& variable) const {
    return {H5Oopen(file, variable.c_str(), H5P_DEFAULT), H5Oclose};
  }
};

NetcdfFile::NetcdfFile(const std::string& filetype, const ProgramInfo& program)
    : state_(std::make_unique<State>()) {
  set_text(root, "Conventions", "CF-1.10");
  set_text(root, "filetype", filetype);
  set_text(root, "format_version", format_version);
  set_text(root, "program", program.name);
  set_text(root, "version", program.version);
  set_text(root, "commit", program.commit);
  set_text(root, "created", now_iso_8601());
}
NetcdfFile::~NetcdfFile() = default;

void NetcdfFile::add_dimension(const VariableFacts& facts, std::span<const double> values) {
  Handle scale =
      write_dataset<double>(state_->file, facts.name, {values.size()}, values, std::nullopt);
  checked(H5DSset_scale(scale, facts.name.c_str()));
  describe(scale, facts);
  state_->dimensions.emplace(facts.name, State::Dimension{values.size(), std::move(scale)});
}

void NetcdfFile::add_variable(const VariableFacts& facts,
                              const std::vector<std::string>& dimensions, Values values) {
  std::vector<hsize_t> shape;
  for (const std::string& name : dimensions) shape.push_back(state_->dimensions.at(name).size);
  const auto write = [&]<class T>(std::span<const T> v) {
    return write_dataset<T>(state_->file, facts.name, shape, v, fill_of(T{}));
  };
  const Handle data = std::visit(write, values);
  describe(data, facts);
  for (unsigned i = 0; i < dimensions.size(); ++i)
    checked(H5DSattach_scale(data, state_->dimensions.at(dimensions[i]).scale, i));
}

void NetcdfFile::add_bytes(const std::string& place, std::span<const std::uint8_t> bytes) {
  const std::string group = place.substr(0, place.find('/'));
  const Handle made(H5Gcreate2(state_->file, group.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                    H5Gclose);
  write_dataset<std::uint8_t>(state_->file, place, {bytes.size()}, bytes, std::nullopt);
}

void NetcdfFile::set_text(const std::string& variable, const char* name, const std::string& text) {
  checked(H5LTset_attribute_string(state_->file, variable.c_str(), name, text.c_str()));
}

void NetcdfFile::add_dimension(const VariableFacts& facts, std::span<const std::string> texts) {
  std::vector<const char*> values;
  for (const std::string& text : texts) values.push_back(text.c_str());
  const Handle type = user_text_type(), space = space_of({values.size()});
  Handle scale(H5Dcreate2(state_->file, facts.name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT,
                          H5P_DEFAULT),
               H5Dclose);
  checked(H5Dwrite(scale, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  checked(H5DSset_scale(scale, facts.name.c_str()));
  describe(scale, facts);
  state_->dimensions.emplace(facts.name, State::Dimension{values.size(), std::move(scale)});
}

// A fixed-length attribute would end at 64 kB and be read as ASCII.
void NetcdfFile::set_user_text(const std::string& variable, const char* name,
                               const std::string& text) {
  const Handle type = user_text_type();
  const char* const value = text.c_str();
  write_attribute(state_->object(variable), name, type, space_of({}), &value);
}

void NetcdfFile::set_numbers(const std::string& variable, const char* name, Values values) {
  const Handle object = state_->object(variable);
  std::visit([&](auto v) { write_numbers(object, name, v); }, values);
}

void NetcdfFile::set_flags(const std::string& variable, const std::vector<std::string>& names) {
  std::vector<std::int64_t> masks;
  while (masks.size() < names.size()) masks.push_back(std::int64_t{1} << masks.size());
  set_numbers(variable, "flag_masks", std::span<const std::int64_t>(masks));
  set_text(variable, "flag_meanings", words(names));
}

void NetcdfFile::set_choices(const std::string& variable, const std::vector<std::string>& names) {
  std::vector<std::int16_t> values(names.size());
  std::iota(values.begin(), values.end(), std::int16_t{0});
  set_numbers(variable, "flag_values", std::span<const std::int16_t>(values));
  set_text(variable, "flag_meanings", words(names));
}

std::string NetcdfFile::image() const {
  checked(H5Fflush(state_->file, H5F_SCOPE_GLOBAL));
  std::string image(static_cast<std::size_t>(checked(H5Fget_file_image(state_->file, nullptr, 0))),
                    '\0');
  checked(H5Fget_file_image(state_->file, image.data(), image.size()));
  return image;
}

}  // namespace sim
