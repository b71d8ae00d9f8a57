// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

struct Inspection;

enum class AnalysisFit { impossible, limited, possible };

const char* to_string(AnalysisFit fit);

/// Whether an analysis of a log is possible, why not, and how to make it possible.
struct PossibleAnalysis {
  std::string name;  ///< "identify", "learn", "torque_residuals", "tracking", "motion"
  std::string what;  ///< description for the user
  AnalysisFit fit = AnalysisFit::impossible;
  std::vector<std::string> channels;  ///< channels that the analysis uses
  std::string why;                    ///< empty when possible without reservation
  std::string help;                   ///< what would make more possible; may be empty
};

std::vector<PossibleAnalysis> possible_analyses(const Inspection& inspection);

}  // namespace faultline
