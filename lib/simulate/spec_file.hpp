// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lib/simulate/simulate.hpp"

namespace faultline {

/// One run of a spec file.
struct RunSpec {
  std::string name;  ///< of the log file, without its extension
  std::uint64_t seed = 1;
  SimulationSpec simulation;
};

/// A simulation spec file (TOML, docs/simulate.md): a robot and the runs it makes.
struct SimulationFile {
  Robot robot;
  std::string robot_path;      ///< path of the robot file that it names; empty: the robot is in the spec
  std::string format = "csv";  ///< extension of the logs: "csv" or "flog"
  std::vector<RunSpec> runs;
};

/// Reads a spec file; a relative path of a robot file counts from the folder of the spec file. Checks every
/// run against the robot. `seed` takes the place of the file's. Throws Error(usage) naming file, line, key,
/// what was found and what was expected.
SimulationFile load_simulation_file(const std::string& path, std::optional<std::uint64_t> seed = {});

/// Reads a spec from text; `where` names it in errors and a robot file's path counts from `folder`.
SimulationFile simulation_from_toml(const std::string& text, const std::string& where,
                                    const std::string& folder, std::optional<std::uint64_t> seed = {});

/// Returns the first line of labels.csv, with its newline.
std::string labels_header();
/// Returns the lines of labels.csv for one run: one for each fault, or one with fault "none".
std::string label_lines(const SimulationFile& file, const RunSpec& spec, const SimulatedRun& run);

}  // namespace faultline
