#include "sim/report/finished_result.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <optional>

#include "sim/failure.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/temporary_folder.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> written_elsewhere(const fs::path& place,
                                          const std::function<void(const fs::path&)>& write) {
  try {
    fs::path other = temporary_folder() / fmt::format("{}-{}{}", place.stem().string(), ::getpid(),
                                                      place.extension().string());
    write(other);
    return other;
  } catch (const Failure&) {
    return std::nullopt;
  }
}

}  // namespace

void keep_finished(const fs::path& place, const std::function<void(const fs::path&)>& write,
                   const std::function<std::string()>& as_json) {
  try {
    write(place);
  } catch (const Failure& failure) {
    const auto other = written_elsewhere(place, write);
    if (!other && !as_json) throw;
    if (!other) print(as_json() + "\n");
    throw Failure(failure.code(),
                  fmt::format("{}; the finished result is {}", failure.what(),
                              other ? "in " + other->string() : "on standard output, as JSON"));
  }
}

}  // namespace sim
