#include "sim/result/hdf5_answers.hpp"

#include <hdf5_hl.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace sim {
namespace {

constexpr hsize_t most_variables = 1000;       // of ours there are some dozen
constexpr std::size_t longest_name = 256;      // of ours none has a quarter
constexpr hsize_t most_chunk_bytes = 1 << 26;  // ours have half a megabyte

Handle opened(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) throw Hdf5Failure();  // a pipe may wait for ever
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  checked(H5Pset_file_locking(access, false, true));  // some network file systems have no locks
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose};
}

template <class T>
std::string as_bytes(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

std::string yes_or_no(htri_t value) { return as_bytes<std::uint8_t>(checked(value) > 0 ? 1 : 0); }

/// A damaged number would fill the memory.
void refuse_too_many(hsize_t cells, std::size_t cell_bytes) {
  if (cell_bytes == 0 || cells > most_answer_bytes / cell_bytes) throw Hdf5Failure();
}

std::string room_for(hsize_t cells, std::size_t cell_bytes) {
  refuse_too_many(cells, cell_bytes);
  return std::string(cells * cell_bytes, '\0');
}

void add_text(std::string& texts, const char* text) {
  const std::size_t length = std::strlen(text);
  if (texts.size() + length >= most_answer_bytes) throw Hdf5Failure();
  texts.append(text, length + 1);
}

hsize_t cells_of(hid_t data_or_attribute, hid_t (*space_of)(hid_t)) {
  const Handle space(space_of(data_or_attribute), H5Sclose);
  return static_cast<hsize_t>(checked(H5Sget_simple_extent_npoints(space)));
}

int rank_of(hid_t data) {
  const Handle space(H5Dget_space(data), H5Sclose);
  return checked(H5Sget_simple_extent_ndims(space));
}

H5T_class_t class_of(hid_t data) {
  const Handle type(H5Dget_type(data), H5Tclose);
  return H5Tget_class(type);
}

const char* class_name(H5T_class_t type) {
  if (type == H5T_STRING) return "text";
  return type == H5T_INTEGER ? "integer" : "";
}

// ---- cells that are there ----

/// Cells for which the file has room in chunks. A chunk is read as a whole: one that would fill the
/// memory is refused.
hsize_t cells_in_chunks(hid_t data, hid_t plist, int rank) {
  const Handle type(H5Dget_type(data), H5Tclose), space(H5Dget_space(data), H5Sclose);
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(rank, 1)));
  if (checked(H5Pget_chunk(plist, rank, shape.data())) != rank) throw Hdf5Failure();
  hsize_t cells = 1;
  for (const hsize_t side : shape) {
    if (side == 0 || side > most_chunk_bytes / cells) throw Hdf5Failure();
    cells *= side;
  }
  if (H5Tget_size(type) > most_chunk_bytes / cells) throw Hdf5Failure();
  hsize_t chunks = 0;
  checked(H5Dget_num_chunks(data, space, &chunks));
  if (chunks > H5S_UNLIMITED / cells) throw Hdf5Failure();
  return chunks * cells;
}

hsize_t cells_in_one_piece(hid_t data) {
  const Handle type(H5Dget_type(data), H5Tclose);
  return H5Dget_storage_size(data) / std::max<hsize_t>(H5Tget_size(type), 1);
}

/// What a file has no room for the library makes up, without end if a damaged number says so. We
/// write all cells.
void refuse_made_up_cells(hid_t data) {
  const Handle plist(H5Dget_create_plist(data), H5Pclose);
  const hsize_t there = H5Pget_layout(plist) == H5D_CHUNKED
                            ? cells_in_chunks(data, plist, rank_of(data))
                            : cells_in_one_piece(data);
  if (cells_of(data, H5Dget_space) > there) throw Hdf5Failure();
}

// ---- attributes ----

std::string text_of_any_length(hid_t attribute, hid_t type) {
  char* value = nullptr;
  checked(H5Aread(attribute, type, &value));
  std::string text = value == nullptr ? "" : value;
  checked(H5free_memory(value));
  return text;
}

std::string text_attribute(hid_t object, const std::string& name) {
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || cells_of(attribute, H5Aget_space) != 1)
    throw Hdf5Failure();
  if (checked(H5Tis_variable_str(type)) > 0) return text_of_any_length(attribute, type);
  std::string text = room_for(1, H5Tget_size(type));
  checked(H5Aread(attribute, type, text.data()));
  return text.substr(0, text.find('\0'));
}

std::string text_if_there(hid_t object, const char* name) {
  return checked(H5Aexists(object, name)) > 0 ? text_attribute(object, name) : "";
}

template <class T>
std::string number_attribute(hid_t object, const std::string& name, hid_t type) {
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
  if (cells_of(attribute, H5Aget_space) != 1) throw Hdf5Failure();
  T value = 0;
  checked(H5Aread(attribute, type, &value));
  return as_bytes(value);
}

// ---- names ----

std::string name_of_link(hid_t file, hsize_t index) {
  std::string name(longest_name, '\0');
  const ssize_t length = checked(H5Lget_name_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_INC, index,
                                                    name.data(), name.size(), H5P_DEFAULT));
  if (static_cast<std::size_t>(length) >= longest_name) throw Hdf5Failure();
  return name;
}

bool is_variable(hid_t file, const std::string& name) {
  H5O_info_t found;
  checked(H5Oget_info_by_name(file, name.c_str(), &found, H5P_DEFAULT));
  return found.type == H5O_TYPE_DATASET;
}

std::string names_of_variables(hid_t file) {
  H5G_info_t group;
  checked(H5Gget_info(file, &group));
  if (group.nlinks > most_variables) throw Hdf5Failure();
  std::string names;
  for (hsize_t i = 0; i < group.nlinks; ++i) {
    const std::string name = name_of_link(file, i);
    if (is_variable(file, name)) add_text(names, name.c_str());
  }
  return names;
}

herr_t add_name_of(hid_t, unsigned, hid_t scale, void* names) {
  std::string name(longest_name, '\0');
  const ssize_t length = H5DSget_scale_name(scale, name.data(), name.size());
  if (length <= 0) return -1;
  name.back() = '\0';
  add_text(*static_cast<std::string*>(names), name.c_str());
  return 1;  // one is enough
}

void add_dimensions_of(hid_t data, std::string& names) {
  const auto rank = static_cast<unsigned>(rank_of(data));
  for (unsigned i = 0; i < rank; ++i) {
    const std::size_t before = names.size();
    checked(H5DSiterate_scales(data, i, nullptr, add_name_of, &names));
    if (names.size() == before) throw Hdf5Failure();
  }
}

}  // namespace

Hdf5Answers::Hdf5Answers(const std::filesystem::path& path) : file_(opened(path)) {}

hid_t Hdf5Answers::variable(const std::string& name) {
  const auto known = open_.find(name);
  if (known != open_.end()) return known->second;
  Handle data(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  refuse_made_up_cells(data);
  return open_.emplace(name, std::move(data)).first->second;
}

std::string Hdf5Answers::description(const std::string& name) {
  const hid_t data = variable(name);
  const bool is_dimension = checked(H5DSis_scale(data)) > 0;
  std::string texts;
  add_text(texts, is_dimension ? "dimension" : "");
  add_text(texts, class_name(class_of(data)));
  for (const char* attribute : {"units", "long_name", "flag_meanings"})
    add_text(texts, text_if_there(data, attribute).c_str());
  if (!is_dimension) add_dimensions_of(data, texts);
  return texts;
}

std::string Hdf5Answers::cells(const std::string& name, hid_t type, std::size_t cell_bytes) {
  const hid_t data = variable(name);
  std::string cells = room_for(cells_of(data, H5Dget_space), cell_bytes);
  checked(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, cells.data()));
  return cells;
}

/// Of any length each.
std::string Hdf5Answers::texts(const std::string& name) {
  const hid_t data = variable(name);
  const Handle type(H5Dget_type(data), H5Tclose);
  const Handle space(H5Dget_space(data), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || checked(H5Tis_variable_str(type)) == 0)
    throw Hdf5Failure();
  const hsize_t count = cells_of(data, H5Dget_space);
  refuse_too_many(count, sizeof(char*));
  std::vector<char*> cells(count);
  checked(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, cells.data()));
  std::string texts;
  for (const char* cell : cells) add_text(texts, cell == nullptr ? "" : cell);
  checked(H5Dvlen_reclaim(type, space, H5P_DEFAULT, cells.data()));
  return texts;
}

std::string Hdf5Answers::some_cells(const Question& question, hid_t type, std::size_t cell_bytes) {
  const hid_t data = variable(question.name);
  if (rank_of(data) != 1) throw Hdf5Failure();
  const hsize_t first = question.first, count = question.count;
  std::string cells = room_for(count, cell_bytes);
  const Handle space(H5Dget_space(data), H5Sclose);
  const Handle room(H5Screate_simple(1, &count, nullptr), H5Sclose);
  checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &count, nullptr));
  checked(H5Dread(data, type, room, space, H5P_DEFAULT, cells.data()));
  return cells;
}

std::string Hdf5Answers::answer(const Question& question) {
  const std::string& name = question.name;
  switch (question.what) {
    case Asked::opens:
      return "";
    case Asked::has_variable:
      return yes_or_no(H5Lexists(file_, name.c_str(), H5P_DEFAULT));
    case Asked::variables:
      return names_of_variables(file_);
    case Asked::description:
      return description(name);
    case Asked::size:
      return as_bytes<std::uint64_t>(
          rank_of(variable(name)) == 1 ? cells_of(variable(name), H5Dget_space) : 0);
    case Asked::integers:
      return cells(name, H5T_NATIVE_INT64, sizeof(std::int64_t));
    case Asked::reals:
      return cells(name, H5T_NATIVE_DOUBLE, sizeof(double));
    case Asked::texts:
      return texts(name);
    case Asked::bytes:
      return some_cells(question, H5T_NATIVE_UINT8, sizeof(std::uint8_t));
    case Asked::floats:
      return some_cells(question, H5T_NATIVE_FLOAT, sizeof(float));
    case Asked::has_attribute:
      return yes_or_no(H5Aexists(file_, name.c_str()));
    case Asked::attribute_text:
      return text_attribute(file_, name);
    case Asked::attribute_whole:
      return number_attribute<std::uint64_t>(file_, name, H5T_NATIVE_UINT64);
    case Asked::attribute_real:
      return number_attribute<double>(file_, name, H5T_NATIVE_DOUBLE);
  }
  throw Hdf5Failure();
}

}  // namespace sim
