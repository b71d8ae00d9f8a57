// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

struct Inspection;

enum class AnalysisFit { impossible, limited, possible };

const char* to_string(AnalysisFit fit);

/// Whether a log is good for something, why not, and what would make it so.
struct PossibleAnalysis {
  std::string name;  ///< "identify", "learn", "torque_residuals", "tracking", "motion"
  std::string what;  ///< to a reader
  AnalysisFit fit = AnalysisFit::impossible;
  std::vector<std::string> channels;  ///< that it takes
  std::string why;                    ///< empty when possible without reserve
  std::string help;                   ///< what would make more possible; empty for nothing
};

std::vector<PossibleAnalysis> possible_analyses(const Inspection& inspection);

}  // namespace faultline
