// Somebody's program under way, where the machine gives too little.
#include "sim/check/child_process.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "sim/failure.hpp"

namespace sim {
namespace {

/// No more than so many files more can be open meanwhile.
class FewFiles {
 public:
  explicit FewFiles(int more) {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    int limit = 0;
    for (int free = 0; free < more || !is_free(limit); ++limit) free += is_free(limit);
    rlimit few = before_;
    few.rlim_cur = static_cast<rlim_t>(limit);
    ::setrlimit(RLIMIT_NOFILE, &few);
  }
  FewFiles(const FewFiles&) = delete;
  FewFiles& operator=(const FewFiles&) = delete;
  ~FewFiles() { ::setrlimit(RLIMIT_NOFILE, &before_); }

 private:
  static bool is_free(int file) { return ::fcntl(file, F_GETFD) < 0; }

  rlimit before_{};
};

// Three pipes are six files; one more tells of its end. It would be waited for in vain.
TEST(ChildProcess, IsRefusedWhereItsEndCouldNotBeSeen) {
  for (int more = 0; more < 7; ++more) {
    const FewFiles few(more);
    EXPECT_THROW(ChildProcess("true"), Failure) << more;
  }
  const FewFiles enough(7);
  std::string output;
  EXPECT_EQ(ChildProcess("echo hello").run({.input = ""}, output), Waited::ended);
  EXPECT_EQ(output, "hello\n");
}

}  // namespace
}  // namespace sim
