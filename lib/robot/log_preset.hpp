// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/robot/toml/toml_table.hpp"

namespace faultline {

/// A file of formats/presets, as it was when the program was built.
struct KnownPreset {
  std::string name;  ///< such as "ur-rtde"
  std::string text;  ///< TOML
};

/// Sorted by name. A part of the program, so that they are found wherever it was installed or copied to.
const std::vector<KnownPreset>& known_presets();

/// The file of a preset that `table` names under `key`: what the columns of a common recorder mean. A name
/// such as "ur-rtde" is looked for in the folder that the environment variable FAULTLINE_PRESETS names, then
/// among those that are built in; a text that ends in .toml is a path. Throws Error(usage) naming those there
/// are.
TomlTable load_log_preset(const TomlTable& table, const std::string& key);

}  // namespace faultline
