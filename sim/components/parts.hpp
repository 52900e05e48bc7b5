#pragma once
// Parts: receiver modules, LEDs, floors and photodiodes, one TOML file each in FOLDER/modules/,
// leds/, floors/ or photodiodes/, in which every number carries its source. A scenario may carry
// such files in its own text.
#include <filesystem>
#include <string>
#include <vector>

#include "channel/emitter.hpp"
#include "channel/floor.hpp"
#include "channel/photodiode.hpp"
#include "channel/receiver_module.hpp"

namespace sim {

/// Folders that hold modules/, leds/, floors/ and photodiodes/.
using PartRoots = std::vector<std::filesystem::path>;

/// A part's file as a scenario carries it.
struct CarriedPart {
  std::string file;  // "modules/x.toml"
  std::string text;
};

/// Where parts are looked for, carried ones first; the first that has a part wins.
struct PartSources {
  PartRoots folders;
  std::vector<CarriedPart> carried;
  std::filesystem::path carrier;  // the scenario's path, for messages
};

template <class Data>
struct Part {
  Data data;
  CarriedPart source;                   // what a scenario must carry to have the same part anywhere
  std::vector<CarriedPart> siblings{};  // and of the parts that its file calls like it
};

/// A part by its name (case aside). `asked` opens the error line if there is no such part.
Part<channel::ModuleData> load_module(const std::string& name, const PartSources& from,
                                      const std::string& asked);
Part<channel::EmitterData> load_led(const std::string& name, const PartSources& from,
                                    const std::string& asked);
Part<channel::Floor> load_floor(const std::string& name, const PartSources& from,
                                const std::string& asked);
Part<channel::PhotodiodeData> load_photodiode(const std::string& name, const PartSources& from,
                                              const std::string& asked);

/// Whether a part's file may have this name: "modules/x.toml", "leds/x.toml".
bool is_part_file(const std::string& file);

struct PartFile {
  std::string kind;  // "module", "LED", "floor" or "photodiode"
  std::string name;  // the file's, without ".toml"
  std::filesystem::path path;
};

/// All parts in the folders, by kind and name; one that an earlier folder hides is left out.
std::vector<PartFile> list_parts(const PartRoots& folders);

}  // namespace sim
