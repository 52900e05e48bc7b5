#include "sim/text/json_answer.hpp"

#include <nlohmann/json.hpp>

namespace sim {
namespace {

using Json = nlohmann::ordered_json;

std::string with_version(const Json& answer, int indent) {
  Json all{{"format_version", json_format_version}};
  all.update(answer);
  return all.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string json_line(const Json& answer) { return with_version(answer, -1) + "\n"; }

std::string json_page(const Json& answer) { return with_version(answer, 2); }

}  // namespace sim
