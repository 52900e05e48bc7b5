// HDF5 traces as captures: what trace writes is read, anything else is refused in a line.
#include "capture_lines.hpp"
#include "program.hpp"
#include "sanitized.hpp"
#include "sim/capture/capture_file.hpp"
#include "sim/result/netcdf.hpp"
#include "sim/trace/trace_netcdf.hpp"

namespace {

using sim::test::edges_us;
using sim::test::failure_of;
using sim::test::Random;

class NetcdfCapture : public CommandLine {
 protected:
  sim::Capture open(const std::string& bytes, const std::string& wire = "") const {
    std::ofstream(path("t.h5"), std::ios::binary) << bytes;
    return sim::open_capture(path("t.h5"), {wire, {}, ""});
  }

  static std::string behind_first_line(const std::string& out) {
    return out.substr(out.find('\n'));
  }

  /// Wires on a grid of whole samples, and every tap.
  static sim::TracedTrial random_trial(Random& random, bool initial, std::size_t rows) {
    sim::TracedTrial trial;
    trial.sample_rate = dsp::Hertz(1e6);
    trial.tx = sim::test::random_trace(random, initial, 20);
    trial.rx = sim::test::random_trace(random, !initial, 30);
    for (const sim::Tap& tap : sim::analogue_taps())
      for (std::size_t i = 0; i < rows; ++i)
        (trial.taps.*tap.samples).push_back(static_cast<float>(sim::test::uniform(random, -1, 1)));
    return trial;
  }

  std::string refusal(const std::string& bytes, const std::string& wire = "") const {
    std::string message = failure_of([&] {
      const sim::Capture capture = open(bytes, wire);
      if (capture.logic) sim::read_whole(*capture.logic);
    });
    const std::size_t at = message.find(path("t.h5").string());
    return at == std::string::npos ? message
                                   : message.replace(at, path("t.h5").string().size(), "t.h5");
  }
};

// More rows than a block has, and fewer.
TEST_F(NetcdfCapture, ReadingUndoesWriting) {
  Random random(71);
  for (const std::size_t rows : {150'000U, 40'000U}) {
    const sim::TracedTrial traced = random_trial(random, rows == 40'000U, rows);
    const std::string bytes = sim::trace_as_netcdf(traced);
    const auto wires = sim::read_whole(*open(bytes).logic);
    ASSERT_EQ(wires.size(), 2U);
    EXPECT_EQ(wires[0].name + wires[1].name, "txrx");
    EXPECT_EQ(wires[0].trace.initial(), traced.tx.initial());
    EXPECT_EQ(edges_us(wires[0].trace), edges_us(traced.tx));
    EXPECT_EQ(edges_us(wires[1].trace), edges_us(traced.rx));
    EXPECT_EQ(wires[1].trace.end().value, (static_cast<double>(rows) + 1) / 1e6);
    for (const sim::Tap& tap : sim::analogue_taps()) {
      const sim::Capture capture = open(bytes, tap.name);
      EXPECT_EQ(capture.samples->sample_rate(), traced.sample_rate);
      std::vector<std::complex<float>> samples(rows + 10);
      ASSERT_EQ(capture.samples->read(samples), rows);
      for (std::size_t i = 0; i < rows; ++i)
        ASSERT_EQ(samples[i].real(), (traced.taps.*tap.samples)[i]);
    }
  }
}

TEST_F(NetcdfCapture, TracesAreDecoded) {
  write_scenario("s.toml", "receiver.range_m = [0.5]");
  ASSERT_EQ(program({"trace", "s.toml", "-o", "t.h5"}).code, 0);
  ASSERT_EQ(program({"trace", "s.toml", "-o", "t.csv"}).code, 0);
  const std::string of_rows = behind_first_line(program({"decode", "t.csv"}).out);
  EXPECT_NE(of_rows.find(" s  ok              IND 011111 OK\n"), std::string::npos);
  EXPECT_EQ(behind_first_line(program({"decode", "t.h5"}).out), of_rows);
  const std::string light = "irradiance_mw_per_m2";
  const std::string of_light = program({"decode", "t.csv", "--channel", light}).out;
  EXPECT_NE(of_light.find(" s  ok              IND 011111 OK\n"), std::string::npos);
  EXPECT_NE(program({"decode", "t.h5", "--channel", light}).out.find(" ok "), std::string::npos);
  std::filesystem::rename(path("t.h5"), path("unnamed"));
  EXPECT_EQ(behind_first_line(program({"decode", "unnamed"}).out), of_rows);
  expect_refused({"decode", "unnamed", "--channel", "irradiance"}, 2,
                 "--channel irradiance is not in unnamed (the trace has no such wire or tap) use "
                 "irradiance_mw_per_m2");
}

// Users cut a trace with either of xarray's engines: what xarray finds on the pin is what is
// decoded.
TEST_F(NetcdfCapture, IsReadAsXarrayReadsAndWritesIt) {
  write_scenario("s.toml", "receiver.range_m = [0.5]");
  ASSERT_EQ(program({"trace", "s.toml", "-o", "t.h5"}).code, 0);
  const std::string script = COSYS_SOURCE_DIR "/tests/sim/cut_trace_with_xarray.py";
  for (const char* engine : {"netcdf4", "h5netcdf"}) {
    const std::string rate = tool(script, {"t.h5", engine, "cut.h5", "cut.bin"});
    const Outcome cut = program({"decode", "cut.h5"});
    EXPECT_EQ(cut.code, 0) << engine << ": " << cut.err;
    EXPECT_NE(cut.out.find("\n   0.015104 s  ok              IND 011111 OK\n"), std::string::npos)
        << "without the fiftieth that was cut off:\n"
        << cut.out;
    const Outcome raw = program({"decode", "cut.bin", "--sample-rate", rate});
    EXPECT_EQ(behind_first_line(cut.out), behind_first_line(raw.out)) << engine;
  }
}

TEST_F(NetcdfCapture, CutShortIsRefused) {
  Random random(72);
  const std::string good = sim::trace_as_netcdf(random_trial(random, true, 40'000));
  for (std::size_t size = 0; size < good.size(); size += 1 + size / 10)
    EXPECT_EQ(refusal(good.substr(0, size)),
              "t.h5 (not an HDF5 file that can be read) choose another file")
        << size;
}

TEST_F(NetcdfCapture, OtherFilesAreRefused) {
  const std::string of_another = sim::NetcdfFile("another", {"x", "1", "2"}).image();
  EXPECT_EQ(refusal(of_another),
            "cannot decode t.h5 (an HDF5 file, but no trace of cosys-sim) give a trace as "
            "cosys-sim writes it");
  EXPECT_EQ(refusal("garbage"), "t.h5 (not an HDF5 file that can be read) choose another file");
  sim::NetcdfFile hollow(sim::trace_type, {"x", "1", "2"});
  EXPECT_EQ(refusal(hollow.image()),
            "t.h5 (no sample_rate_hz in it: damaged, or of another program) choose another file");
  const double rate = 0;
  hollow.set_numbers(sim::NetcdfFile::root, "sample_rate_hz", std::span(&rate, 1));
  EXPECT_EQ(refusal(hollow.image()),
            "cannot decode t.h5 (its sample rate is none) give a trace as cosys-sim writes it");
}

// Half of the rounds bend what the file begins with, its structure, and half any of its bytes,
// which are mostly samples. More in damaged_files_test.cpp. In a process of its own: what the
// library leaves open of a damaged file it may speak of at exit.
TEST_F(NetcdfCapture, BentIsReadOrRefusedInALine) {
  Random random(73);
  const std::string good = sim::trace_as_netcdf(random_trial(random, true, 2'000));
  int refused = 0;
  for (int round = 0; round < 20; ++round) {
    std::string bad = good;
    const std::size_t reach = round % 2 == 0 ? 2048 : bad.size();
    for (auto n = 1 + random() % 60; n > 0; --n)
      bad[random() % reach] = static_cast<char>(random());
    std::ofstream(path("t.h5"), std::ios::binary) << bad;
    const Outcome o = program({"decode", "t.h5", "--baud", "600"});
    EXPECT_TRUE(o.code == 0 || o.code == 2) << round << ": " << o.code;
    const std::string err = sim::test::without_refused_sizes(o.err);
    EXPECT_EQ(std::ranges::count(err, '\n'), 1) << err;  // no message in it, or why not
    refused += o.code == 2;
  }
  EXPECT_GT(refused, 3);
  EXPECT_LT(refused, 20);
}

}  // namespace
