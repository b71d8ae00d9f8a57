// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace faultline {

/// Runs a Python script in the folder; false when Python or what it imports is not there, or it fails.
inline bool run_python(const TemporaryFolder& folder, const std::string& script) {
  const std::string path = folder.write("script.py", script);
  const std::string command =
      "cd '" + folder.path().string() + "' && PATH=/usr/bin:$PATH python3 '" + path + "' >/dev/null 2>&1";
  return std::system(command.c_str()) == 0;
}

}  // namespace faultline
