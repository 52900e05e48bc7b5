#pragma once
// Files and pipes that users name, read as a stream in bounded memory. What is no file that can be
// read is refused with the line that read_text_file gives.
#include <array>
#include <filesystem>
#include <istream>
#include <streambuf>
#include <string>
#include <string_view>

namespace sim {

/// Throws Failure(bad_input) for a folder and for what is not there. `what` says what the file
/// should be: "scenario".
void refuse_no_file(const std::filesystem::path& path, const std::string& what);

/// A file open for reading, without waiting for the other end of a pipe to be opened.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Bytes read, waiting for at least one, which is said once if it takes long; 0 at the end.
  /// Throws where the file cannot be read.
  std::size_t read(char* to, std::size_t size);

 private:
  std::string name_;
  int number_;
  bool told_ = false;  // that it waits
};

/// A stream of the bytes of a file: readers that must not swallow a Failure use its rdbuf().
class InputStream : public std::istream {
 public:
  InputStream(const std::filesystem::path& path, const std::string& what);

  /// The bytes at hand before any was read, 16 or more unless there are fewer: what a format is
  /// recognised by.
  std::string_view beginning() { return bytes_.at_hand(); }

 private:
  class Bytes : public std::streambuf {
   public:
    explicit Bytes(const std::filesystem::path& path) : file_(path), chunk_() {}
    std::string_view at_hand();

   private:
    int_type underflow() override;

    InputFile file_;
    std::array<char, 65536> chunk_;
  };

  Bytes bytes_;
};

}  // namespace sim
