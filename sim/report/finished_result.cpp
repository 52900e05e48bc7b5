#include "sim/report/finished_result.hpp"

#include <fmt/format.h>
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
    const fs::path folder = new_temporary_folder("cosys-sim-kept.");
    fs::path other = folder / place.filename();
    try {
      write(other);
    } catch (const Failure&) {
      std::error_code ignored;
      fs::remove(folder, ignored);
      throw;
    }
    return other;
  } catch (const Failure&) {
    return std::nullopt;
  }
}

bool is_printed(const std::function<std::string()>& as_text) {
  if (!as_text) return false;
  try {
    print_json(as_text() + "\n");
    return true;
  } catch (const Failure&) {
    return false;
  }
}

std::string where_it_is(const fs::path& place, const std::function<void(const fs::path&)>& write,
                        const std::function<std::string()>& as_text) {
  if (const auto other = written_elsewhere(place, write)) return "in " + other->string();
  return is_printed(as_text) ? "on standard output" : "lost, as nothing else takes it";
}

}  // namespace

void keep_finished(const fs::path& place, const std::function<void(const fs::path&)>& write,
                   const std::function<std::string()>& as_text) {
  try {
    write(place);
  } catch (const Failure& failure) {
    throw Failure(failure.code(), fmt::format("{}; what was counted is {}", failure.what(),
                                              where_it_is(place, write, as_text)));
  }
}

}  // namespace sim
