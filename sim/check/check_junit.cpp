#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>

#include "sim/check/check_report.hpp"
#include "sim/text/existing_file.hpp"

namespace sim {
namespace {

/// What XML 1.0 cannot hold becomes a question mark.
std::string xml_text(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return (c < 0x20 && c != '\n' && c != '\t') || c > 0x7e; }, '?');
  return text;
}

constexpr const char* suite_head = "cosys-sim check of ";

/// `kind`: failure, error or skipped.
void add_outcome(pugi::xml_node test, const char* kind, const std::string& message,
                 const std::string& body) {
  pugi::xml_node node = test.append_child(kind);
  node.append_attribute("message") = xml_text(message).c_str();
  node.append_attribute("type") = kind;
  node.text() = xml_text(body).c_str();
}

std::string junit_message(const CheckReport& report, const PointCheck& check) {
  if (check.fault) return "the decoder failed: " + check.fault->what;
  return fmt::format("{} is {}: {} frames lost, {} by {}; {} accepted wrongly, {} by {}",
                     report.setup.candidate.name(), name(check.verdict), check.candidate.lost,
                     check.baseline.lost, report.baseline.decoder, check.candidate.undetected_error,
                     check.baseline.undetected_error, report.baseline.decoder);
}

void add_point(pugi::xml_node suite, const CheckReport& report, const PointCheck& check) {
  pugi::xml_node test = suite.append_child("testcase");
  test.append_attribute("name") = xml_text(check.point.name).c_str();
  test.append_attribute("classname") =
      xml_text("cosys-sim." + check.point.file.stem().string()).c_str();
  const std::string details = point_details(report, check);
  if (check.verdict == Verdict::worse)
    add_outcome(test, "failure", junit_message(report, check), details);
  if (check.verdict == Verdict::broken)
    add_outcome(test, "error", junit_message(report, check), details);
  if (check.verdict == Verdict::inconclusive)
    add_outcome(test, "skipped", junit_message(report, check), details);
  if (check.verdict == Verdict::passed)
    test.append_child("system-out").text() = xml_text(details).c_str();
}

}  // namespace

std::string check_junit(const CheckReport& report) {
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node suite = document.append_child("testsuite");
  suite.append_attribute("name") = xml_text(suite_head + report.setup.candidate.name()).c_str();
  suite.append_attribute("tests") = report.checks.size();
  suite.append_attribute("failures") = report.count(Verdict::worse);
  suite.append_attribute("errors") = report.count(Verdict::broken);
  suite.append_attribute("skipped") = report.count(Verdict::inconclusive);
  for (const PointCheck& check : report.checks) add_point(suite, report, check);
  std::ostringstream out;
  document.save(out, "  ");
  return out.str();
}

bool is_check_junit(const std::filesystem::path& path) {
  constexpr std::size_t head_bytes = 200;
  const std::string key = std::string("<testsuite name=\"") + suite_head;
  return beginning_of(path, head_bytes).find(key) != std::string::npos;
}

}  // namespace sim
