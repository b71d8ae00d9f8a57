// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/simulate/spec_file.hpp"

namespace faultline {

/// First line of labels.csv, with its newline.
std::string labels_header();
/// The lines of labels.csv for one run: one each fault, or one with fault "none".
std::string label_lines(const SimulationFile& file, const RunSpec& spec, const SimulatedRun& run);

}  // namespace faultline
