#include "sim/components/part_axis.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

#include "sim/components/part_slot.hpp"
#include "sim/failure.hpp"
#include "sim/scenario/text_axis.hpp"
#include "sim/text/letters.hpp"

namespace sim {
namespace {

/// Names of all parts in a folder of this name, carried or not; those of files, in lower case.
std::vector<std::string> names_in(const std::string& folder, const PartSources& from) {
  std::vector<std::string> names;
  for (const CarriedPart& part : from.carried) {
    const std::filesystem::path file(part.file);
    if (file.parent_path() == folder) names.push_back(in_lower_case(file.stem().string()));
  }
  for (const PartFile& part : list_parts(from.folders))
    if (part.path.parent_path().filename() == folder) names.push_back(in_lower_case(part.name));
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::vector<std::string> all_names(const Axis& axis, const PartSources& from,
                                   const std::string& place) {
  const std::string& folder = part_slot(axis.key).folder;
  auto names = names_in(folder, from);
  if (names.empty())
    throw bad_input(axis.key + " = \"*\" " + place, "there is no part of this kind",
                    "add a file " + folder + "/NAME.toml");
  return names;
}

/// With the file of that part alone: others may stand in for what is not loaded yet.
Assembly assemble_one(const std::string& name, const PartSlot& slot, const AssembleWith& assemble) {
  Assembly one = assemble(name);
  std::erase_if(one.parts, [&](const CarriedPart& part) {
    return std::filesystem::path(part.file).parent_path() != slot.folder;
  });
  return one;
}

std::vector<Assembly> assemble_all(const std::vector<std::string>& names, const PartSlot& slot,
                                   const AssembleWith& assemble) {
  std::vector<Assembly> all;
  all.reserve(names.size());
  for (const std::string& name : names) all.push_back(assemble_one(name, slot, assemble));
  std::erase_if(all, [&](const Assembly& a) { return !slot.to_be_had(a.scenario); });
  return all;
}

}  // namespace

std::string any_part(const Axis& axis, const PartSources& from, const std::string& place) {
  const std::string& first = axis.labels.front();
  return first == all_texts ? all_names(axis, from, place).front() : first;
}

std::vector<Assembly> load_part_axis(Axis& axis, const PartSources& from, const std::string& place,
                                     const AssembleWith& assemble) {
  const PartSlot& slot = part_slot(axis.key);
  std::vector<Assembly> loaded;
  for (const std::string& label : axis.labels) {
    if (label == all_texts)
      std::ranges::move(assemble_all(all_names(axis, from, place), slot, assemble),
                        std::back_inserter(loaded));
    else
      loaded.push_back(assemble_one(label, slot, assemble));
  }
  std::vector<std::string> names;
  for (const Assembly& a : loaded) names.push_back(slot.name(a.scenario));
  set_labels(axis, std::move(names), place);
  return loaded;
}

}  // namespace sim
