#include "sim/text/new_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <string>
#include <system_error>
#include <utility>

#include "sim/failure.hpp"
#include "sim/text/write_all.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

constexpr const char* other_place = "choose another place";
constexpr std::string_view ending = ".tmp";

// A link is written through, not replaced.
fs::path resolved(const fs::path& place) {
  std::error_code error, ignored;
  fs::path target = fs::canonical(place, error);
  if (!error) return target;
  if (!fs::is_symlink(fs::symlink_status(place, ignored))) return place;
  throw bad_input("cannot write " + place.string(),
                  error == std::errc::too_many_symbolic_link_levels ? "it is a link to itself"
                                                                    : "it is a link to nothing",
                  "remove the link or choose another name");
}

fs::path folder_of(const fs::path& place) {
  return place.has_parent_path() ? place.parent_path() : ".";
}

bool is_running(pid_t process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

/// The process in "PLACE.PID.tmp"; 0 for another name.
pid_t writer_of(std::string_view name, std::string_view place) {
  if (!name.starts_with(place) || !name.ends_with(ending)) return 0;
  if (name.size() <= place.size() + 1 + ending.size() || name[place.size()] != '.') return 0;
  const char* const end = name.data() + name.size() - ending.size();
  pid_t process = 0;
  const auto [rest, error] = std::from_chars(name.data() + place.size() + 1, end, process);
  return error == std::errc() && rest == end && process > 0 ? process : 0;
}

void remove_left_over(const fs::path& place) {
  const std::string name = place.filename().string();
  std::error_code error;
  fs::directory_iterator entry(folder_of(place), error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const pid_t writer = writer_of(entry->path().filename().string(), name);
    if (writer != 0 && !is_running(writer)) ::unlink(entry->path().c_str());
  }
}

}  // namespace

void check_place(const fs::path& place, const OwnFiles& own) {
  refuse_to_lose(place, own);
  const NewFile probe(place);
}

void refuse_to_lose(const fs::path& place, const OwnFiles& own) {
  std::error_code error;
  if (!fs::is_regular_file(place, error) || fs::file_size(place, error) == 0 || own.is_own(place))
    return;
  throw bad_input("cannot write " + place.string(), std::string("it exists and is not ") + own.name,
                  "choose another name");
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw Failure(ExitCode::environment, "cannot create the folder " + folder.string() + " (" +
                                             error.message() + ") " + other_place);
}

void write_file(const fs::path& place, std::string_view bytes) {
  NewFile file(place);
  file.write(bytes);
  file.take_place();
}

void write_files(const std::vector<WholeFile>& files) {
  for (const WholeFile& file : files)
    if (file.place.has_parent_path()) make_folder(file.place.parent_path());
  std::deque<NewFile> written;
  for (const WholeFile& file : files) written.emplace_back(file.place).write(file.text);
  take_places(written);
}

NewFile::NewFile(const fs::path& place)
    : place_(resolved(place)), beside_(place_.string() + "." + std::to_string(::getpid())) {
  beside_ += ending;
  refuse_what_is_no_file();
  remove_left_over(place_);
  descriptor_ =
      ::open(beside_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail();
}

NewFile::~NewFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!in_place_) ::unlink(beside_.c_str());
}

void NewFile::write(std::string_view bytes) {
  if (!write_all(descriptor_, bytes)) fail();
}

void NewFile::close() {
  if (descriptor_ < 0) return;
  if (::fsync(descriptor_) != 0) fail();
  if (::close(std::exchange(descriptor_, -1)) != 0) fail();
}

void NewFile::take_place() {
  close();
  if (::rename(beside_.c_str(), place_.c_str()) != 0) fail();
  in_place_ = true;
}

void take_places(std::deque<NewFile>& files) {
  for (NewFile& file : files) file.close();
  if (files.size() > 1)
    std::for_each(files.rbegin(), files.rend(),
                  [](const NewFile& file) { ::unlink(file.place_.c_str()); });
  for (NewFile& file : files) file.take_place();
}

void NewFile::refuse_what_is_no_file() const {
  std::error_code error;
  const auto status = fs::status(place_, error);
  if (fs::is_directory(status)) fail("it is a folder", "add a file name");
  if (fs::exists(status) && !fs::is_regular_file(status))
    fail("it is not a regular file", other_place);
}

void NewFile::fail() const {
  const int reason = errno;
  std::error_code error;
  if (reason == ENOENT && !fs::is_directory(folder_of(place_), error))
    fail("its folder does not exist", "create the folder or choose another");
  const std::string why = std::generic_category().message(reason);
  fail(why.c_str(),
       reason == ENOSPC ? "free some space there or choose another place" : other_place);
}

void NewFile::fail(const char* why, const char* suggestion) const {
  throw Failure(ExitCode::environment,
                "cannot write " + place_.string() + " (" + why + ") " + suggestion);
}

}  // namespace sim
