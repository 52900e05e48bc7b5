// The process that reads an HDF5 file: whatever becomes of it, who asks gets an answer or a line.
#include "sim/result/reading_process.hpp"

#include <csignal>
#include <memory>
#include <optional>

#include "program.hpp"
#include "sim/failure.hpp"
#include "sim/result/netcdf.hpp"

namespace sim {
namespace {

const Question filetype{.what = Asked::attribute_text, .name = "filetype"};

class ReadingProcessTest : public CommandLine {
 protected:
  ReadingProcessTest() { write("a.h5", NetcdfFile("a kind", {"x", "1", "2"}).image()); }

  /// Those of this thread.
  static std::vector<pid_t> children() {
    std::istringstream numbers(content("/proc/thread-self/children"));
    std::vector<pid_t> all;
    for (pid_t one = 0; numbers >> one;) all.push_back(one);
    return all;
  }

  static std::string refusal(ReadingProcess& process) {
    try {
      return process.ask(filetype).value_or("no answer");
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::bad_input);
      return failure.what();
    }
  }
};

TEST_F(ReadingProcessTest, AnswersOrSaysThatThereIsNoSuchThing) {
  ReadingProcess process(path("a.h5"));
  EXPECT_EQ(process.ask(filetype), "a kind");
  EXPECT_EQ(process.ask({Asked::integers, "none"}), std::nullopt);
  EXPECT_EQ(process.ask({Asked::integers, std::string(1'000'000, 'n')}), std::nullopt);
  EXPECT_EQ(process.ask(filetype), "a kind");
  EXPECT_EQ(ReadingProcess(path("none.h5")).ask(filetype), std::nullopt);
  write("text.h5", "text");
  EXPECT_EQ(ReadingProcess(path("text.h5")).ask({Asked::opens}), std::nullopt);
}

TEST_F(ReadingProcessTest, MayFall) {
  ReadingProcess process(path("a.h5"));
  ASSERT_EQ(children().size(), 1U);
  ::kill(children().front(), SIGSEGV);
  const std::string line =
      path("a.h5").string() + " (damaged: the HDF5 library falls over it) choose another file";
  EXPECT_EQ(refusal(process), line);
  EXPECT_EQ(refusal(process), line);
  EXPECT_TRUE(children().empty());
}

TEST_F(ReadingProcessTest, IsNotWaitedForForEver) {
  ReadingProcess process(path("a.h5"));
  ASSERT_EQ(children().size(), 1U);
  ::kill(children().front(), SIGSTOP);
  const std::string line =
      path("a.h5").string() +
      " (no answer within 6 s: damaged, or on a disk that does not answer) choose another file";
  EXPECT_EQ(refusal(process), line);
  EXPECT_EQ(refusal(process), line);
  EXPECT_TRUE(children().empty());
}

TEST_F(ReadingProcessTest, EndsWithItsOwnerThoughAYoungerOneLives) {
  auto old = std::make_unique<ReadingProcess>(path("a.h5"));
  ReadingProcess young(path("a.h5"));
  EXPECT_EQ(children().size(), 2U);
  old.reset();
  EXPECT_EQ(children().size(), 1U);
  EXPECT_EQ(young.ask(filetype), "a kind");
}

TEST_F(ReadingProcessTest, HeedsNoSignalOfTheTerminal) {
  ReadingProcess process(path("a.h5"));
  EXPECT_EQ(process.ask(filetype), "a kind");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::kill(children().front(), signal);
  EXPECT_EQ(process.ask(filetype), "a kind");
}

}  // namespace
}  // namespace sim
