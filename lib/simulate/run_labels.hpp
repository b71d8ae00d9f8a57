// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/simulate/spec_file.hpp"

namespace faultline {

/// Returns the first line of labels.csv, with its newline.
std::string labels_header();
/// Returns the lines of labels.csv for one run: one for each fault, or one with fault "none".
std::string label_lines(const SimulationFile& file, const RunSpec& spec, const SimulatedRun& run);

}  // namespace faultline
