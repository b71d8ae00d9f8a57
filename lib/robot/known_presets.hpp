// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

/// A file of formats/presets, as it was when the program was built.
struct KnownPreset {
  std::string name;  ///< such as "ur-rtde"
  std::string text;  ///< TOML
};

/// Sorted by name. A part of the program, so that they are found wherever it was installed or copied to.
const std::vector<KnownPreset>& known_presets();

}  // namespace faultline
