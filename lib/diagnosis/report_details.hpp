// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/diagnosis/run_curves.hpp"

namespace faultline {

/// Facts for a person to read, a row each.
struct FactTable {
  std::string title;
  std::vector<std::string> head;  ///< empty for name and value
  std::vector<std::vector<std::string>> rows;
};

/// What a page shows besides the diagnosis: the course of the run, and what the model knows of itself.
struct ReportDetails {
  RunCurves curves;
  std::vector<FactTable> model;       ///< identified parameters, how good the model is
  std::vector<FactTable> provenance;  ///< what somebody needs who must repeat the diagnosis
};

}  // namespace faultline
