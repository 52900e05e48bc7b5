// `cosys-sim parts`: what parts there are, and what is known of one.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "sim/command/commands.hpp"
#include "sim/failure.hpp"
#include "sim/report/part_report.hpp"
#include "sim/report/part_sheet.hpp"
#include "sim/text/letters.hpp"
#include "sim/text/spelling.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/text_file.hpp"

namespace sim {
namespace {

bool mentions(const PartFile& part, const std::string& wanted) {
  const std::string text = read_text_file(part.path, part.kind);
  return in_lower_case(part.kind + " " + part.name + "\n" + text).find(wanted) != std::string::npos;
}

std::vector<PartFile> matching(const PartsRequest& request) {
  const std::string wanted = in_lower_case(request.search);
  std::vector<PartFile> parts = list_parts(request.parts);
  std::erase_if(parts, [&](const PartFile& part) { return !mentions(part, wanted); });
  return parts;
}

std::vector<PartFile> named(const PartsRequest& request) {
  std::vector<PartFile> found, all = list_parts(request.parts);
  std::vector<std::string> names;
  for (const PartFile& part : all) {
    names.push_back(part.name);
    if (in_lower_case(part.name) == in_lower_case(request.name)) found.push_back(part);
  }
  if (found.empty())
    throw bad_input(request.name, "no part of this name",
                    names.empty() ? "add one to a folder of --parts"
                                  : "did you mean " + nearest(request.name, names) + "?");
  return found;
}

/// A part that cannot be read says so in its line: the others are still worth listing.
PartSheet listed(const PartFile& file, const PartRoots& folders) {
  try {
    return read_part_sheet(file, folders, Compare::no);
  } catch (const Failure& failure) {
    PartSheet sheet{};
    sheet.kind = file.kind;
    sheet.name = file.name;
    sheet.path = file.path;
    sheet.summary = failure.what();
    return sheet;
  }
}

ExitCode list(const PartsRequest& request) {
  std::vector<PartSheet> sheets;
  for (const PartFile& part : matching(request)) sheets.push_back(listed(part, request.parts));
  if (sheets.empty() && !request.search.empty())
    throw bad_input("--search " + request.search, "no part mentions it",
                    "leave it out to see all parts");
  request.json ? print_json(parts_json(sheets)) : print(parts_table(sheets));
  return ExitCode::done;
}

}  // namespace

ExitCode parts_command(const PartsRequest& request) {
  if (request.name.empty()) return list(request);
  for (const PartFile& part : named(request)) {
    const PartSheet sheet = read_part_sheet(part, request.parts, Compare::yes);
    request.json ? print_json(sheet_json(sheet)) : print(sheet_text(sheet));
  }
  return ExitCode::done;
}

}  // namespace sim
