#pragma once
// A folder of ours for captures that decoders of users read. A decoder may leave there what it
// likes: captures are new files, never what stands there already.
#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

#include "sim/serial/descriptor.hpp"

namespace sim {

/// Gone with its owner. It is locked as long as its owner lives, and one that a killed check left
/// is removed by the next.
class CaptureFolder {
 public:
  /// Throws Failure(environment) where TMPDIR can hold none.
  CaptureFolder();
  CaptureFolder(const CaptureFolder&) = delete;
  CaptureFolder& operator=(const CaptureFolder&) = delete;
  ~CaptureFolder();

  const std::filesystem::path& path() const { return path_; }

  /// A new capture, from any thread. Throws Failure(environment) where it cannot be written.
  std::filesystem::path write(const char* ending, const std::string& bytes);
  void remove(const std::filesystem::path& capture) const;

 private:
  std::filesystem::path path_;
  std::optional<Descriptor> folder_;
  std::atomic<int> n_ = 0;
};

}  // namespace sim
