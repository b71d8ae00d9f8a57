// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

/// A file of formats/presets, with its content at build time.
struct KnownPreset {
  std::string name;  ///< such as "ur-rtde"
  std::string text;  ///< TOML
};

/// Presets sorted by name. They are compiled in, so they need no installed files.
const std::vector<KnownPreset>& known_presets();

}  // namespace faultline
