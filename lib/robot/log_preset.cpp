// SPDX-License-Identifier: MIT
#include "lib/robot/log_preset.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "lib/core/atomic_file.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = ".toml";

std::vector<fs::path> preset_folders() {
  std::vector<fs::path> folders;
  if (const char* own = std::getenv("FAULTLINE_PRESETS")) folders.emplace_back(own);
  folders.emplace_back(FAULTLINE_PRESET_FOLDER);
  return folders;
}

/// Names of all presets, sorted.
std::string presets_there_are() {
  std::vector<std::string> names;
  std::error_code none;
  for (const fs::path& folder : preset_folders())
    for (const auto& entry : fs::directory_iterator(folder, none))
      if (entry.path().extension() == kExtension) names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

TomlTable load_log_preset(const TomlTable& table, const std::string& key) {
  const std::string name = table.text(key);
  if (name.ends_with(kExtension)) return TomlTable::parse(read_file(name), name);
  std::error_code none;
  for (const fs::path& folder : preset_folders()) {
    const fs::path path = folder / (name + kExtension);
    if (name.find('/') == std::string::npos && fs::exists(path, none))
      return TomlTable::parse(read_file(path.string()), path.string());
  }
  table.fail(key, "there is no preset \"" + name + "\"; there are " + presets_there_are() +
                      ", and a path that ends in .toml is a file of your own");
}

}  // namespace faultline
