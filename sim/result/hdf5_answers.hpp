#pragma once
// The one place that opens HDF5 files to read them. HDF5's library (1.10 to 1.14) falls over some
// damaged files, or never comes back from them, instead of refusing them: see the issues 1368, 4351
// and 5382 of github.com/HDFGroup/hdf5. So this is for the child of ReadingProcess alone.
#include <filesystem>
#include <map>
#include <string>

#include "sim/result/hdf5_handle.hpp"
#include "sim/result/hdf5_question.hpp"

namespace sim {

class Hdf5Answers {
 public:
  /// This and all else throws Hdf5Failure of what is not there, is of another kind, or is larger
  /// than anything of ours.
  explicit Hdf5Answers(const std::filesystem::path& path);

  /// In the form that Asked says.
  std::string answer(const Question& question);

 private:
  hid_t variable(const std::string& name);
  std::string description(const std::string& name);
  std::string cells(const std::string& name, hid_t type, std::size_t cell_bytes);
  std::string texts(const std::string& name);
  std::string some_cells(const Question& question, hid_t type, std::size_t cell_bytes);

  SilentErrors silent_;
  Handle file_;
  std::map<std::string, Handle> open_;  // variables that were asked of
};

}  // namespace sim
