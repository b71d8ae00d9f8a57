// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace faultline {

/// Progress of long work as a line for a file or a pipe: "faultline:  42 % reading run.csv".
struct ProgressLine {
  std::string step;
  double share = 0.0;  ///< 0 to 1
};

/// Returns the line without a line break; a share that is not finite counts as 0.
std::string to_text(const ProgressLine& line);
/// Returns what to_text() was called with, to a percent; nullopt for another line.
std::optional<ProgressLine> parsed_progress(const std::string& line);

}  // namespace faultline
