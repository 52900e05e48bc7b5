#include "sim/components/parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "sim/components/part_reader.hpp"
#include "sim/failure.hpp"
#include "sim/scenario/key_check.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/text/spelling.hpp"
#include "sim/text/text_file.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

std::vector<PartFile> parts_in(const fs::path& folder, const std::string& kind) {
  std::vector<PartFile> parts;
  std::error_code ignored;  // a root need not have the folder
  for (fs::directory_iterator file(folder, ignored), end; file != end; file.increment(ignored))
    if (file->path().extension() == ".toml" && file->is_regular_file(ignored))
      parts.push_back({kind, file->path().stem().string(), file->path()});
  std::ranges::sort(parts, {}, &PartFile::path);
  return parts;
}

template <class Data>
std::vector<PartFile> all_parts(const PartKeys<Data>& keys, const PartRoots& roots) {
  std::vector<PartFile> all;
  for (const auto& root : roots)
    for (PartFile& part : parts_in(root / keys.folder, keys.kind))
      if (std::ranges::none_of(all, [&](const auto& p) { return same_name(p.name, part.name); }))
        all.push_back(std::move(part));
  std::ranges::sort(all, {}, &PartFile::name);
  return all;
}

/// The kind of a part of this name; empty where there is none.
std::string kind_named(const std::string& name, const PartRoots& folders) {
  const std::vector<PartFile> all = list_parts(folders);
  const auto found =
      std::ranges::find_if(all, [&](const PartFile& part) { return same_name(part.name, name); });
  return found == all.end() ? "" : found->kind;
}

std::string name_instead(const std::string& name, const std::vector<std::string>& names) {
  const std::string guess = nearest(name, names);
  return is_near(name, guess) ? fmt::format("did you mean {}?", guess)
                              : "cosys-sim parts lists all that there are";
}

template <class Data>
Failure no_such_part(const PartKeys<Data>& keys, const std::string& name, const PartSources& from,
                     const std::vector<PartFile>& parts, const std::string& asked) {
  std::vector<std::string> folders, names;
  for (const auto& root : from.folders) folders.push_back((root / keys.folder).generic_string());
  for (const auto& part : parts) names.push_back(part.name);
  if (const std::string other = kind_named(name, from.folders); !other.empty())
    return bad_input(
        asked, fmt::format("{} is the name of a part of the kind {}", name, other),
        fmt::format("name a part of the kind {}: cosys-sim parts lists them", keys.kind));
  return bad_input(
      asked,
      fmt::format("no {} of this name in {}", keys.kind,
                  folders.empty() ? "any folder" : fmt::format("{}", fmt::join(folders, ", "))),
      names.empty() ? fmt::format("add a file {}/NAME.toml", keys.folder)
                    : name_instead(name, names));
}

std::string file_of(const std::string& folder, const std::string& name) {
  return folder + "/" + name + ".toml";
}

/// Names of parts, each of which is like the next.
using Kinship = std::vector<std::string>;

template <class Data>
Part<Data> load_part(const PartKeys<Data>& keys, const std::string& name, const PartSources& from,
                     const std::string& asked, const Kinship& of = {});

/// The sibling that the last of its kin names.
template <class Data>
Part<Data> load_sibling(const PartKeys<Data>& keys, const SiblingName& sibling,
                        const PartSources& from, const Kinship& kin) {
  const std::string asked = fmt::format("like = \"{}\" {}", sibling.name, sibling.place);
  if (std::ranges::any_of(kin, [&](const auto& one) { return same_name(one, sibling.name); }))
    throw bad_input(asked, "parts that are like each other in a circle have no numbers",
                    "give one of them its own");
  return load_part(keys, sibling.name, from, asked, kin);
}

template <class Data>
Part<Data> read_part(const PartKeys<Data>& keys, CarriedPart source, const fs::path& path,
                     const PartSources& from, Kinship kin) {
  kin.push_back(path.stem().string());
  const auto sibling = sibling_of(source.text, path);
  if (!sibling) return {read_part_text(keys, source.text, path, kin.back()), std::move(source)};
  Part<Data> other = load_sibling(keys, *sibling, from, kin);
  Data data = read_part_text(keys, source.text, path, kin.back(), &other.data);
  other.siblings.push_back(std::move(other.source));
  return {std::move(data), std::move(source), std::move(other.siblings)};
}

template <class Data>
Part<Data> load_part(const PartKeys<Data>& keys, const std::string& name, const PartSources& from,
                     const std::string& asked, const Kinship& of) {
  for (const CarriedPart& part : from.carried)
    if (same_name(part.file, file_of(keys.folder, name)))
      return read_part(keys, {file_of(keys.folder, fs::path(part.file).stem().string()), part.text},
                       from.carrier / part.file, from, of);
  const auto parts = all_parts(keys, from.folders);
  for (const auto& part : parts)
    if (same_name(part.name, name))
      return read_part(keys,
                       {file_of(keys.folder, part.name), read_text_file(part.path, keys.kind)},
                       part.path, from, of);
  throw no_such_part(keys, name, from, parts, asked);
}

}  // namespace

Part<channel::ModuleData> load_module(const std::string& name, const PartSources& from,
                                      const std::string& asked) {
  return load_part(module_keys(), name, from, asked);
}

Part<channel::EmitterData> load_led(const std::string& name, const PartSources& from,
                                    const std::string& asked) {
  return load_part(led_keys(), name, from, asked);
}

Part<channel::Floor> load_floor(const std::string& name, const PartSources& from,
                                const std::string& asked) {
  return load_part(floor_keys(), name, from, asked);
}

Part<channel::PhotodiodeData> load_photodiode(const std::string& name, const PartSources& from,
                                              const std::string& asked) {
  return load_part(photodiode_keys(), name, from, asked);
}

bool is_part_file(const std::string& file) {
  const fs::path path(file);
  const std::string folder = path.parent_path().generic_string();
  return path.extension() == ".toml" &&
         (folder == module_keys().folder || folder == led_keys().folder ||
          folder == floor_keys().folder || folder == photodiode_keys().folder);
}

std::vector<PartFile> list_parts(const PartRoots& folders) {
  auto parts = all_parts(led_keys(), folders);
  for (const auto& more : {all_parts(floor_keys(), folders), all_parts(module_keys(), folders),
                           all_parts(photodiode_keys(), folders)})
    parts.insert(parts.end(), more.begin(), more.end());
  return parts;
}

}  // namespace sim
