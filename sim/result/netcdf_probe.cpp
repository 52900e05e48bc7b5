#include "sim/result/netcdf_probe.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <vector>

#include "sim/result/hdf5_handle.hpp"

namespace sim {
namespace {

constexpr unsigned longest_s = 60;  // some damage is a ring of references
constexpr hsize_t most_bytes = 1 << 24;
constexpr hsize_t most_probed_cells = 1 << 16;

std::vector<std::byte> room_for(hid_t type, hsize_t cells) {
  const hsize_t size = std::max<hsize_t>(H5Tget_size(type), 1);
  if (size > most_bytes || cells > most_bytes / size) throw Hdf5Failure();
  return std::vector<std::byte>(size * cells);
}

herr_t try_attribute(hid_t object, const char* name, const H5A_info_t*, void*) {
  try {
    const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    const Handle space(H5Aget_space(attribute), H5Sclose);
    const auto cells = static_cast<hsize_t>(checked(H5Sget_simple_extent_npoints(space)));
    checked(H5Aread(attribute, type, room_for(type, cells).data()));
  } catch (const Hdf5Failure&) {  // refused in order: the others may be worse
  }
  return 0;
}

void try_first_cells(hid_t data) {
  const Handle type(H5Dget_type(data), H5Tclose);
  const Handle space(H5Dget_space(data), H5Sclose);
  if (checked(H5Sget_simple_extent_ndims(space)) != 1) return;
  const hsize_t first = 0;
  const hsize_t cells = std::min(
      most_probed_cells, static_cast<hsize_t>(checked(H5Sget_simple_extent_npoints(space))));
  const Handle room(H5Screate_simple(1, &cells, nullptr), H5Sclose);
  checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &cells, nullptr));
  checked(H5Dread(data, type, room, space, H5P_DEFAULT, room_for(type, cells).data()));
}

herr_t try_variable(hid_t file, const char* name, const H5L_info_t*, void*) {
  try {
    const Handle data(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
    const Handle plist(H5Dget_create_plist(data), H5Pclose);
    try_first_cells(data);
  } catch (const Hdf5Failure&) {  // as above
  }
  return 0;
}

void try_file(const std::filesystem::path& path) {
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  H5Aiterate2(file, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, try_attribute, nullptr);
  H5Literate(file, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, try_variable, nullptr);
}

[[noreturn]] void try_and_exit(const std::filesystem::path& path) {
  alarm(longest_s);
  dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDERR_FILENO);  // last words of the C library
  try {
    try_file(path);
  } catch (const std::exception&) {  // refused in order, or too large: whoever reads will say it
  }
  _exit(0);
}

}  // namespace

bool survives_reading(const std::filesystem::path& path) {
  const pid_t child = fork();
  if (child < 0) return true;  // no room for a process: then without
  if (child == 0) try_and_exit(path);
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return true;  // whoever started us has its children reaped
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace sim
