// One run on several processes gives what one process gives. Where MPI is installed.
#ifdef COSYS_MPIRUN
#include <chrono>
#include <csignal>
#include <thread>

#include "program.hpp"
#include "small_experiments.hpp"

namespace {

class Mpi : public CommandLine {
 protected:
  Mpi() {
    // A test may run as root.
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    write_scenario("s.toml", "receiver.range_m = [1, 2.2, 3]");
  }

  static Words job(int members, const Words& arguments) {
    Words words{"-n", std::to_string(members), "--oversubscribe", COSYS_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
  }
  Outcome mpirun(int members, const Words& arguments) const {
    return start_tool(COSYS_MPIRUN, job(members, arguments)).finish();
  }
};

TEST_F(Mpi, AnyNumberOfProcessesGivesTheSameCounts) {
  for (const Words& rule : {Words{"-n", "203", "-e", "0"}, {"-n", "2000", "-e", "50"}}) {
    Words run{"run", "s.toml", "-q", "-t", "1"};
    run.insert(run.end(), rule.begin(), rule.end());
    const std::string alone = program(run).out;
    for (const int members : {1, 3}) {
      std::filesystem::remove(path("s.h5"));
      const Outcome o = mpirun(members, run);
      EXPECT_EQ(o.code, 0) << o.err;
      EXPECT_EQ(digest_of(o.out), digest_of(alone)) << members;
      EXPECT_EQ(std::ranges::count(o.out, '\n'), std::ranges::count(alone, '\n'));
    }
  }
}

// A sum of weights depends on the order in which it is made.
TEST_F(Mpi, HoweverErrorsAreMade) {
  write("rare.toml", "receiver.ebn0_db = 35.4\n");
  for (const Words& way :
       {Words{"receiver.module=TSSP4056", "simulation.method=importance"},
        {"receiver.module=TSSP4056", "simulation.fidelity=envelope"},
        {"receiver.module=ideal-coherent", "receiver.ebn0_db=8", "simulation.fidelity=decision"}}) {
    Words run{"run", "rare.toml", "-q", "-t", "1", "-n", "72", "-e", "0"};
    for (const std::string& key : way) run.insert(run.end(), {"--set", key});
    const std::string alone = digest_of(program(run).out);
    const bool is_weighted = way.back() == "simulation.method=importance";
    for (const int members : is_weighted ? std::vector{2, 3} : std::vector{3}) {
      std::filesystem::remove(path("rare.h5"));
      const Outcome o = mpirun(members, run);
      EXPECT_EQ(o.code, 0) << o.err;
      EXPECT_EQ(digest_of(o.out), alone) << way.back() << ", " << members;
    }
  }
}

TEST_F(Mpi, OtherExperimentsThanLinksToo) {
  for (const sim::test::Experiment& experiment : sim::test::small_experiments) {
    SCOPED_TRACE(experiment.name);
    write("e.toml", sim::test::scenario_of(experiment, false));
    const Words run{"run", "e.toml", "-q", "-t", "1"};
    const Outcome alone = program(run);
    const Outcome o = mpirun(2, run);
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(o.out, alone.out);
  }
}

TEST_F(Mpi, TheyStopAtTheSameRun) {
  write("d.toml",
        sim::test::scenario_of(sim::test::small_experiments[3], false) + "stop.rel_ci = 0.1\n");
  const Words run{"run", "d.toml", "-q", "-t", "1", "--set", "presence.trials=2000"};
  const Outcome alone = program(run);
  EXPECT_EQ(alone.code, 0) << alone.err;
  const std::string trials = values("d.h5", "n_trials");
  EXPECT_LT(std::stoi(trials), 2000);
  EXPECT_EQ(mpirun(3, run).out, alone.out);
  EXPECT_EQ(values("d.h5", "n_trials"), trials);
}

TEST_F(Mpi, GoesOnWithWhatWasLeft) {
  const Words run{"run", "s.toml", "-q", "-n", "1500", "-e", "0", "-t", "1"};
  const std::string whole = digest_of(program(run).out);
  std::filesystem::remove(path("s.h5"));
  Running running = start_program(run);
  running.line();
  running.finish(SIGTERM);
  Words again = run;
  again.emplace_back("--resume");
  EXPECT_EQ(digest_of(mpirun(2, again).out), whole);
}

TEST_F(Mpi, ASignalEndsTheJobInOrder) {
  const Words run{"run", "s.toml", "-q", "-n", "1500", "-e", "0", "-t", "1"};
  const std::string whole = digest_of(program(run).out);
  std::filesystem::remove(path("s.h5"));
  Running running = start_tool(COSYS_MPIRUN, job(2, run));
  for (int i = 0; i < 3; ++i) running.line();  // the table's head
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_NE(running.finish(SIGTERM).code, 0);
  Words again = run;
  again.emplace_back("--resume");
  EXPECT_EQ(digest_of(mpirun(2, again).out), whole);
}

// Members on other machines may see other files.
TEST_F(Mpi, RefusesFilesThatDiffer) {
  for (const char* rank : {"0", "1"}) {
    std::filesystem::create_directory(path(rank));
    write(std::string(rank) + "/s.toml", std::string("led.current_ma = 9") + rank + "\n");
  }
  const std::string program = "cd $OMPI_COMM_WORLD_RANK && exec " COSYS_PROGRAM " run s.toml -q";
  const Outcome o =
      start_tool(COSYS_MPIRUN, {"-n", "2", "--oversubscribe", "sh", "-c", program}).finish();
  EXPECT_EQ(o.code, 3);
  EXPECT_NE(o.err.find("cosys-sim: the processes of the job read different files"),
            std::string::npos)
      << o.err;
}

TEST_F(Mpi, OnlyRunIsShared) {
  const Outcome o = mpirun(2, {"find", "s.toml", "--over", "receiver.range_m"});
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("only cosys-sim run can share its work out"), std::string::npos) << o.err;
  EXPECT_EQ(mpirun(1, {"encode", "x"}).code, 0);
}

TEST_F(Mpi, RefusesOnceForAll) {
  const Outcome o = mpirun(3, {"run", "none.toml", "-q"});
  EXPECT_EQ(o.code, 2);
  const std::string line = "cosys-sim: ";
  const std::size_t first = o.err.find(line);
  ASSERT_NE(first, std::string::npos) << o.err;
  EXPECT_EQ(o.err.find(line, first + 1), std::string::npos) << o.err;
  EXPECT_EQ(mpirun(2, {"run", "s.toml", "--plan"}).code, 2);
  EXPECT_EQ(files(), std::set<std::string>{"s.toml"});
}

/// A member of the job, none of whose words tell it from the others; 0 while there is none.
pid_t a_member(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::error_code error;
    if (std::filesystem::read_symlink(entry.path() / "cwd", error) != folder) continue;
    if (std::filesystem::read_symlink(entry.path() / "exe", error).filename() == "cosys-sim" &&
        content(entry.path() / "environ").find("OMPI_COMM_WORLD_RANK=1") != std::string::npos)
      return static_cast<pid_t>(std::stoi(entry.path().filename()));
  }
  return 0;
}

// A member that dies ends the job with mpirun's words, and the file can be gone on with.
TEST_F(Mpi, ADyingMemberEndsTheJobAndLosesLittle) {
  const Words run{"run", "s.toml", "-q", "-n", "100000", "-e", "0", "-t", "1"};
  Running running = start_tool(COSYS_MPIRUN, job(2, run));
  for (int i = 0; i < 600 && !std::filesystem::exists(path("s.h5")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const pid_t member = a_member(std::filesystem::canonical(folder()));
  ASSERT_GT(member, 0);
  ::kill(member, SIGKILL);
  const Outcome o = running.finish();
  EXPECT_NE(o.code, 0);
  EXPECT_NE(o.err.find("exited on signal 9 (Killed)"), std::string::npos) << o.err;
  const std::string counted = values("s.h5", "n_frames");
  EXPECT_NE(counted.substr(0, 2), "0,");
  Words again = run;
  again.emplace_back("--resume");
  Running resumed = start_program(again);
  resumed.await_handler(SIGTERM);
  EXPECT_EQ(resumed.finish(SIGTERM).code, 130);
  EXPECT_GE(std::stoll(values("s.h5", "n_frames")), std::stoll(counted));
}

}  // namespace
#elif !defined(COSYS_WITHOUT_MPI)
#include <gtest/gtest.h>

TEST(Mpi, IsThere) { GTEST_SKIP() << "needs MPI (Debian: libopenmpi-dev, openmpi-bin)"; }
#endif
