// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/robot/toml/toml_table.hpp"

namespace faultline {

/// A file of formats/presets, with its content at build time.
struct KnownPreset {
  std::string name;  ///< such as "ur-rtde"
  std::string text;  ///< TOML
};

/// Presets sorted by name. They are compiled in, so they need no installed files.
const std::vector<KnownPreset>& known_presets();

/// Returns the preset that `table` names under `key`: the meaning of the columns of a common recorder. Looks
/// for a name such as "ur-rtde" in the folder that the environment variable FAULTLINE_PRESETS names, then
/// among the built-in presets; takes a text that ends in .toml as a path. Throws Error(usage) that lists the
/// available presets.
TomlTable load_log_preset(const TomlTable& table, const std::string& key);

}  // namespace faultline
