#include "sim/result/netcdf_reader.hpp"

#include <fmt/format.h>

#include "sim/result/hdf5_handle.hpp"
#include "sim/result/netcdf.hpp"

namespace sim {
namespace {

Handle open_file(const std::filesystem::path& path) {
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
  if (H5Tget_class(type) != H5T_STRING) throw Hdf5Failure();
  if (checked(H5Tis_variable_str(type)) > 0) return text_of_any_length(attribute, type);
  std::string text(static_cast<std::size_t>(checked(H5Aget_storage_size(attribute))), '\0');
  checked(H5Aread(attribute, type, text.data()));
  return text.substr(0, text.find('\0'));
}

template <class T>
std::vector<T> cells_of(hid_t file, const std::string& variable, hid_t type) {
  const Handle data(H5Dopen2(file, variable.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle space(H5Dget_space(data), H5Sclose);
  std::vector<T> cells(static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space))));
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
  std::vector<char*> cells(static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space))));
  checked(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, cells.data()));
  std::vector<std::string> texts;
  for (const char* cell : cells) texts.emplace_back(cell == nullptr ? "" : cell);
  checked(H5Dvlen_reclaim(type, space, H5P_DEFAULT, cells.data()));
  return texts;
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
    : state_(new State{path.string(), SilentErrors(), open_file(path)}) {
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
    const Handle attribute(H5Aopen(file, name, H5P_DEFAULT), H5Aclose);
    const Handle space(H5Aget_space(attribute), H5Sclose);
    if (checked(H5Sget_simple_extent_npoints(space)) != 1) throw Hdf5Failure();
    std::uint64_t value = 0;
    checked(H5Aread(attribute, H5T_NATIVE_UINT64, &value));
    return value;
  });
}

}  // namespace sim
