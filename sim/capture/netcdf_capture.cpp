#include "sim/capture/netcdf_capture.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/capture/capture_units.hpp"
#include "sim/capture/raw_capture.hpp"
#include "sim/failure.hpp"
#include "sim/result/netcdf.hpp"
#include "sim/result/netcdf_reader.hpp"
#include "sim/text/spelling.hpp"

namespace sim {
namespace {

constexpr std::size_t block_rows = 65536;  // a chunk of our files

Failure unreadable_trace(const std::filesystem::path& path, const char* why) {
  return bad_input("cannot decode " + path.string(), why, "give a trace as cosys-sim writes it");
}

/// A trace's rows from the first on.
class Rows {
 public:
  Rows(const std::filesystem::path& path, const CaptureSettings& settings)
      : path_(path), reader_(path) {
    if (filetype_of(path) != trace_type)
      throw unreadable_trace(path, "an HDF5 file, but no trace of cosys-sim");
    rate_ = *settings.rate_over(dsp::Hertz(reader_.real_number("sample_rate_hz")));
    if (!is_sample_rate(rate_)) throw unreadable_trace(path, "its sample rate is none");
    count_ = reader_.size("rx");
    if (reader_.size("tx") != count_) throw unreadable_trace(path, "tx is not as long as rx");
  }

  dsp::Hertz rate() const { return rate_; }

  /// Wires and taps; the first column is their time.
  std::vector<std::string> columns() const {
    std::vector<std::string> names;
    for (const std::string& name : reader_.variables())
      if (name != "time_s" && reader_.size(name) == count_) names.push_back(name);
    return names;
  }

  /// The rows that follow, at most so many, of these columns; to be passed over by skip().
  template <class T>
  std::vector<T> next(const std::string& column, std::size_t most) const {
    std::vector<T> cells(std::min(most, count_ - done_));
    reader_.read(column, done_, std::span<T>(cells));
    return cells;
  }
  void skip(std::size_t rows) { done_ += rows; }

  void refuse_infinite(const std::vector<float>& cells) const {
    if (!std::ranges::all_of(cells, [](float cell) { return std::isfinite(cell); }))
      throw unreadable_trace(path_, "a sample is not finite");
  }

 private:
  std::filesystem::path path_;
  NetcdfReader reader_;
  dsp::Hertz rate_;
  std::size_t count_ = 0, done_ = 0;
};

/// tx in bit 0, rx in bit 1. A row is read at the end of its sample, so the first stands for the
/// start of the trace too.
class WireBlocks {
 public:
  explicit WireBlocks(std::shared_ptr<Rows> rows) : rows_(std::move(rows)) {}

  std::span<const std::uint8_t> operator()() {
    block_ = rows_->next<std::uint8_t>("tx", block_rows);
    const auto rx = rows_->next<std::uint8_t>("rx", block_rows);
    for (std::size_t i = 0; i < block_.size(); ++i)
      block_[i] = static_cast<std::uint8_t>((block_[i] != 0 ? 1 : 0) | (rx[i] != 0 ? 2 : 0));
    rows_->skip(block_.size());
    if (std::exchange(first_, false) && !block_.empty())
      block_.insert(block_.begin(), block_.front());
    return block_;
  }

 private:
  std::shared_ptr<Rows> rows_;
  std::vector<std::uint8_t> block_;
  bool first_ = true;
};

class TapSamples : public SampleCapture {
 public:
  TapSamples(std::shared_ptr<Rows> rows, std::string tap)
      : rows_(std::move(rows)), tap_(std::move(tap)) {}

  dsp::Hertz sample_rate() const override { return rows_->rate(); }
  bool is_complex() const override { return false; }

  std::size_t read(std::span<std::complex<float>> to) override {
    std::size_t count = 0;
    while (count < to.size()) {
      const auto cells = rows_->next<float>(tap_, std::min(block_rows, to.size() - count));
      if (cells.empty()) break;
      rows_->refuse_infinite(cells);
      rows_->skip(cells.size());
      for (const float cell : cells) to[count++] = cell;
    }
    return count;
  }

 private:
  std::shared_ptr<Rows> rows_;
  std::string tap_;
};

}  // namespace

void open_netcdf(const std::filesystem::path& path, const CaptureSettings& settings,
                 Capture& capture) {
  const auto rows = std::make_shared<Rows>(path, settings);
  capture.facts.time = samples_text(rows->rate());
  const std::string& wanted = settings.wire;
  if (wanted.empty() || wanted == "tx" || wanted == "rx") {
    capture.logic = std::make_unique<LogicSamples>(std::vector<std::string>{"tx", "rx"}, 1,
                                                   rows->rate(), WireBlocks(rows));
    return;
  }
  const std::vector<std::string> columns = rows->columns();
  if (std::ranges::find(columns, wanted) == columns.end())
    throw bad_input("--channel " + wanted + " is not in " + path.string(),
                    "the trace has no such wire or tap", "use " + nearest(wanted, columns));
  capture.samples = std::make_unique<TapSamples>(rows, wanted);
  capture.facts.channels.push_back({wanted, std::nullopt});
  capture.facts.taken = 0;
}

}  // namespace sim
