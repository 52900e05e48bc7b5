#pragma once
// For those who write HDF5 files or read them (hdf5_answers). HDF5's identifiers as values that
// close themselves, its failures as exceptions.
#include <hdf5.h>

#include <utility>

#include "sim/failure.hpp"

namespace sim {

/// Thrown where the library says no. A file is built in memory, where only a lack of it can fail;
/// who reads one catches this and says what is wrong with the file.
struct Hdf5Failure : Failure {
  Hdf5Failure()
      : Failure(ExitCode::environment,
                "cannot build the HDF5 file (the library gave up: out of memory?) free some memory "
                "or ask for less") {}
};

template <class Status>
Status checked(Status status) {
  if (status < 0) throw Hdf5Failure();
  return status;
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

// HDF5 prints what fails, of itself; here that is thrown. At exit it would print what a file that
// could not be built leaves open, unless it is told before all else that nothing is to do.
class SilentErrors {
 public:
  SilentErrors() {
    H5dont_atexit();
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

}  // namespace sim
