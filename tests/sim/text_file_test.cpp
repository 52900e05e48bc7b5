// Files that users name, and what they are answered where there is no text to read.
#include "sim/text/text_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "sim/failure.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

/// A folder that lasts as long as one test.
class TextFile : public testing::Test {
 protected:
  TextFile() {
    std::string name = (fs::temp_directory_path() / "cosys_text.XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~TextFile() override { fs::remove_all(folder_); }

  fs::path path(const char* name) const { return folder_ / name; }

  /// The answer to a file, its folder's name cut out.
  std::string refusal(const char* name, std::size_t longest = mebibyte) const {
    try {
      read_text_file(path(name), "capture", longest);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::bad_input);
      const std::string line = failure.what(), folder = folder_.generic_string() + "/";
      return line.starts_with(folder) ? line.substr(folder.size()) : line;
    }
    return "accepted";
  }

 private:
  fs::path folder_;
};

TEST_F(TextFile, IsReadToItsLastByte) {
  const std::string text = "a\r\n\0b" + std::string(200'000, 'x');
  std::ofstream(path("a"), std::ios::binary) << text;
  EXPECT_EQ(read_text_file(path("a"), "scenario"), text);
}

TEST_F(TextFile, LimitIsTheCallers) {
  std::ofstream(path("a")) << "a";
  fs::resize_file(path("a"), mebibyte);
  EXPECT_EQ(refusal("a"), "accepted");
  fs::resize_file(path("a"), mebibyte + 1);
  EXPECT_EQ(refusal("a"), "a (longer than 1 MiB) shorten it or name a capture file");
  EXPECT_EQ(refusal("a", 2 * mebibyte), "accepted");
}

TEST_F(TextFile, WhatHasNoTextIsNamed) {
  fs::create_directory(path("d.vcd"));
  EXPECT_EQ(refusal("d.vcd"), "d.vcd (a folder, not a capture file) name a file in it");
  EXPECT_EQ(refusal("no"), "no (no such file) check the path");
}

TEST_F(TextFile, APipeThatNobodyWritesToIsNotWaitedFor) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(refusal("pipe"), "pipe (a pipe that nothing is written to) start its writer first");
}

TEST_F(TextFile, APipeIsReadUntilItsWriterEnds) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  std::thread writer([to = ends[1]] {
    const std::string half(70'000, 'x');  // more than a pipe holds
    for (int i = 0; i < 2; ++i) EXPECT_EQ(::write(to, half.data(), half.size()), 70'000);
    ::close(to);
  });
  EXPECT_EQ(read_text_file("/dev/fd/" + std::to_string(ends[0]), "scenario"),
            std::string(140'000, 'x'));
  writer.join();
  ::close(ends[0]);
}

}  // namespace
}  // namespace sim
