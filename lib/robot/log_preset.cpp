// SPDX-License-Identifier: MIT
#include "lib/robot/log_preset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "lib/core/atomic_file.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = ".toml";

/// The folder of the user's own presets; empty if there is none.
fs::path own_folder() {
  const char* own = std::getenv("FAULTLINE_PRESETS");
  return own ? own : "";
}

/// Returns the names of all presets, sorted and joined by commas.
std::string presets_there_are() {
  std::vector<std::string> names;
  for (const KnownPreset& preset : known_presets()) names.push_back(preset.name);
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(own_folder(), none))
    if (entry.path().extension() == kExtension) names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

TomlTable load_log_preset(const TomlTable& table, const std::string& key) {
  const std::string name = table.text(key);
  if (name.ends_with(kExtension)) return TomlTable::parse(read_file(name), name);
  const fs::path own = own_folder() / (name + kExtension);
  std::error_code none;
  if (!own_folder().empty() && name.find('/') == std::string::npos && fs::exists(own, none))
    return TomlTable::parse(read_file(own.string()), own.string());
  for (const KnownPreset& preset : known_presets())
    if (preset.name == name) return TomlTable::parse(preset.text, "preset " + name);
  table.fail(key, "there is no preset \"" + name + "\"; there are " + presets_there_are() +
                      ", and a path that ends in .toml is a file of your own");
}

}  // namespace faultline
