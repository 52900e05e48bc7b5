#include "sim/result/netcdf_reader.hpp"

#include <fmt/format.h>
#include <hdf5_hl.h>

#include <algorithm>

#include "sim/result/hdf5_handle.hpp"
#include "sim/result/netcdf.hpp"
#include "sim/result/netcdf_probe.hpp"
#include "sim/text/input_file.hpp"

namespace sim {
namespace {

Handle open_file(const std::filesystem::path& path) {
  if (!survives_reading(path)) throw Hdf5Failure();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  checked(H5Pset_file_locking(access, false, true));  // some network file systems have no locks
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose};
}

std::string text_of_any_length(hid_t attribute, hid_t type) {
  char* value = nullptr;
  checked(H5Aread(attribute, type, &value));
  std::string text = value == nullptr ? "" : value;
  checked(H5free_memory(value));
  return text;
}

std::string text_attribute(hid_t file, const char* name) {
  const Handle attribute(H5Aopen(file, name, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || checked(H5Sget_simple_extent_npoints(space)) != 1)
    throw Hdf5Failure();
  if (checked(H5Tis_variable_str(type)) > 0) return text_of_any_length(attribute, type);
  std::string text(static_cast<std::size_t>(checked(H5Aget_storage_size(attribute))), '\0');
  checked(H5Aread(attribute, type, text.data()));
  return text.substr(0, text.find('\0'));
}

constexpr hssize_t most_cells = hssize_t{1} << 28;  // a damaged number would fill the memory

std::size_t cells_in(hid_t space) {
  const hssize_t cells = checked(H5Sget_simple_extent_npoints(space));
  if (cells > most_cells) throw Hdf5Failure();
  return static_cast<std::size_t>(cells);
}

template <class T>
std::vector<T> cells_of(hid_t file, const std::string& variable, hid_t type) {
  const Handle data(H5Dopen2(file, variable.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle space(H5Dget_space(data), H5Sclose);
  std::vector<T> cells(cells_in(space));
  checked(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, cells.data()));
  return cells;
}

/// Of any length each.
std::vector<std::string> texts_of(hid_t file, const std::string& variable) {
  const Handle data(H5Dopen2(file, variable.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type(H5Dget_type(data), H5Tclose);
  const Handle space(H5Dget_space(data), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || checked(H5Tis_variable_str(type)) == 0)
    throw Hdf5Failure();
  std::vector<char*> cells(cells_in(space));
  checked(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, cells.data()));
  std::vector<std::string> texts;
  for (const char* cell : cells) texts.emplace_back(cell == nullptr ? "" : cell);
  checked(H5Dvlen_reclaim(type, space, H5P_DEFAULT, cells.data()));
  return texts;
}

constexpr hsize_t most_variables = 1000;  // of ours there are a dozen
constexpr hsize_t most_chunk_cells = 1 << 24;

std::string name_of_variable(hid_t file, hsize_t index) {
  const auto name = [&](char* to, std::size_t size) {
    return static_cast<std::size_t>(checked(
        H5Lget_name_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_INC, index, to, size, H5P_DEFAULT)));
  };
  std::string text(name(nullptr, 0), '\0');
  name(text.data(), text.size() + 1);
  return text;
}

/// A chunk is read as a whole: one that would fill the memory is refused.
void check_chunk(hid_t data) {
  const Handle plist(H5Dget_create_plist(data), H5Pclose);
  if (H5Pget_layout(plist) != H5D_CHUNKED) return;
  hsize_t cells = 0;
  checked(H5Pget_chunk(plist, 1, &cells));
  if (cells > most_chunk_cells) throw Hdf5Failure();
}

std::size_t cells_on_one_dimension(hid_t file, const std::string& variable) {
  const Handle data(H5Dopen2(file, variable.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle space(H5Dget_space(data), H5Sclose);
  if (checked(H5Sget_simple_extent_ndims(space)) != 1) return 0;
  return static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space)));
}

void read_cells(hid_t file, const std::string& variable, hsize_t first, hsize_t count, hid_t type,
                void* to) {
  const Handle data(H5Dopen2(file, variable.c_str(), H5P_DEFAULT), H5Dclose);
  check_chunk(data);
  const Handle space(H5Dget_space(data), H5Sclose);
  const Handle room(H5Screate_simple(1, &count, nullptr), H5Sclose);
  checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &count, nullptr));
  checked(H5Dread(data, type, room, space, H5P_DEFAULT, to));
}

herr_t add_name_of(hid_t, unsigned, hid_t scale, void* names) {
  constexpr std::size_t longest = 256;
  std::string name(longest, '\0');
  const ssize_t length = H5DSget_scale_name(scale, name.data(), name.size());
  if (length <= 0) return -1;
  name.resize(std::min(static_cast<std::size_t>(length), longest - 1));
  static_cast<std::vector<std::string>*>(names)->push_back(name);
  return 1;  // one is enough
}

std::vector<std::string> dimensions_in(hid_t file, const std::string& variable) {
  const Handle data(H5Dopen2(file, variable.c_str(), H5P_DEFAULT), H5Dclose);
  if (H5DSis_scale(data) > 0) return {};
  const Handle space(H5Dget_space(data), H5Sclose);
  const auto rank = static_cast<unsigned>(checked(H5Sget_simple_extent_ndims(space)));
  std::vector<std::string> names;
  for (unsigned i = 0; i < rank; ++i) {
    checked(H5DSiterate_scales(data, i, nullptr, add_name_of, &names));
    if (names.size() != i + 1) throw Hdf5Failure();
  }
  return names;
}

H5T_class_t class_of(hid_t file, const std::string& variable) {
  const Handle data(H5Dopen2(file, variable.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type(H5Dget_type(data), H5Tclose);
  return H5Tget_class(type);
}

template <class T>
T number_attribute(hid_t file, const char* name, hid_t type) {
  const Handle attribute(H5Aopen(file, name, H5P_DEFAULT), H5Aclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  if (checked(H5Sget_simple_extent_npoints(space)) != 1) throw Hdf5Failure();
  T value = 0;
  checked(H5Aread(attribute, type, &value));
  return value;
}

}  // namespace

std::string filetype_of(const std::filesystem::path& path) {
  const SilentErrors silent;
  try {
    return text_attribute(open_file(path), "filetype");
  } catch (const Hdf5Failure&) {
    return "";  // another kind of file
  }
}

struct NetcdfReader::State {
  std::string path;
  SilentErrors silent;
  Handle file;

  /// What `read` gives; names the file and what was looked for if there is no such thing.
  template <class Read>
  auto get(const std::string& what, const Read& read) const {
    try {
      return read(file);
    } catch (const Hdf5Failure&) {
      throw bad_input(path, "no " + what + " in it: damaged, or of another program",
                      "choose another file");
    }
  }
};

bool is_result_of_run(const std::filesystem::path& path) {
  const std::string type = filetype_of(path);
  return type == link_result_type || type == experiment_result_type;
}

NetcdfReader::NetcdfReader(const std::filesystem::path& path) try
    : state_((refuse_no_file(path, "result"),
              new State{path.string(), SilentErrors(), open_file(path)})) {
} catch (const Hdf5Failure&) {
  throw bad_input(path.string(), "not an HDF5 file that can be read", "choose another file");
}
NetcdfReader::~NetcdfReader() = default;

bool NetcdfReader::has(const std::string& variable) const {
  return state_->get(variable, [&](hid_t file) {
    return checked(H5Lexists(file, variable.c_str(), H5P_DEFAULT)) > 0;
  });
}

std::vector<std::int64_t> NetcdfReader::integers(const std::string& variable) const {
  return state_->get(variable, [&](hid_t file) {
    return cells_of<std::int64_t>(file, variable, H5T_NATIVE_INT64);
  });
}

std::vector<double> NetcdfReader::reals(const std::string& variable) const {
  return state_->get(
      variable, [&](hid_t file) { return cells_of<double>(file, variable, H5T_NATIVE_DOUBLE); });
}

std::vector<std::string> NetcdfReader::texts(const std::string& variable) const {
  return state_->get(variable, [&](hid_t file) { return texts_of(file, variable); });
}

std::vector<std::string> NetcdfReader::variables() const {
  return state_->get("variables", [&](hid_t file) {
    H5G_info_t group;
    checked(H5Gget_info(file, &group));
    if (group.nlinks > most_variables) throw Hdf5Failure();
    std::vector<std::string> names;
    for (hsize_t i = 0; i < group.nlinks; ++i) names.push_back(name_of_variable(file, i));
    return names;
  });
}

std::vector<std::string> NetcdfReader::dimensions(const std::string& variable) const {
  return state_->get(variable, [&](hid_t file) { return dimensions_in(file, variable); });
}

bool NetcdfReader::is_dimension(const std::string& variable) const {
  return state_->get(variable, [&](hid_t file) {
    const Handle data(H5Dopen2(file, variable.c_str(), H5P_DEFAULT), H5Dclose);
    return checked(H5DSis_scale(data)) > 0;
  });
}

bool NetcdfReader::is_text(const std::string& variable) const {
  return state_->get(variable, [&](hid_t file) { return class_of(file, variable) == H5T_STRING; });
}

bool NetcdfReader::is_integer(const std::string& variable) const {
  return state_->get(variable, [&](hid_t file) { return class_of(file, variable) == H5T_INTEGER; });
}

std::string NetcdfReader::text_of(const std::string& variable, const char* name) const {
  return state_->get(variable, [&](hid_t file) {
    const Handle data(H5Dopen2(file, variable.c_str(), H5P_DEFAULT), H5Dclose);
    return checked(H5Aexists(data, name)) > 0 ? text_attribute(data, name) : std::string();
  });
}

std::size_t NetcdfReader::size(const std::string& variable) const {
  return state_->get(variable, [&](hid_t file) { return cells_on_one_dimension(file, variable); });
}

void NetcdfReader::read(const std::string& variable, std::size_t first,
                        std::span<std::uint8_t> to) const {
  state_->get(variable, [&](hid_t file) {
    read_cells(file, variable, first, to.size(), H5T_NATIVE_UINT8, to.data());
  });
}

void NetcdfReader::read(const std::string& variable, std::size_t first, std::span<float> to) const {
  state_->get(variable, [&](hid_t file) {
    read_cells(file, variable, first, to.size(), H5T_NATIVE_FLOAT, to.data());
  });
}

std::string NetcdfReader::text(const char* name) const {
  return state_->get(name, [&](hid_t file) { return text_attribute(file, name); });
}

std::string NetcdfReader::text(const char* name, const char* otherwise) const {
  const bool there =
      state_->get(name, [&](hid_t file) { return checked(H5Aexists(file, name)) > 0; });
  return there ? text(name) : otherwise;
}

std::uint64_t NetcdfReader::whole_number(const char* name) const {
  return state_->get(name, [&](hid_t file) {
    return number_attribute<std::uint64_t>(file, name, H5T_NATIVE_UINT64);
  });
}

double NetcdfReader::real_number(const char* name) const {
  return state_->get(
      name, [&](hid_t file) { return number_attribute<double>(file, name, H5T_NATIVE_DOUBLE); });
}

}  // namespace sim
