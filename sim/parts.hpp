#pragma once
// Parts: receiver modules and LEDs, one TOML file each in ROOT/modules/ or ROOT/leds/, in which
// every number carries its source.
#include <filesystem>
#include <string>
#include <vector>

#include "channel/emitter.hpp"
#include "channel/receiver_module.hpp"

namespace sim {

/// Folders that hold modules/ and leds/; the first that has a part wins.
using PartRoots = std::vector<std::filesystem::path>;

/// A part by its name (case aside). `asked` opens the error line if there is no such part.
channel::ModuleData load_module(const std::string& name, const PartRoots& roots,
                                const std::string& asked);
channel::EmitterData load_led(const std::string& name, const PartRoots& roots,
                              const std::string& asked);

struct PartFile {
  std::string kind;  // "module" or "LED"
  std::string name;  // the file's, without ".toml"
  std::filesystem::path path;
};

/// All parts to be had, by kind and name; one that an earlier root hides is left out.
std::vector<PartFile> list_parts(const PartRoots& roots);

}  // namespace sim
