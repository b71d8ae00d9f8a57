// SPDX-License-Identifier: MIT
#include "lib/simulate/run_labels.hpp"

#include <fmt/format.h>

#include "lib/core/csv_cell.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {

std::string labels_header() {
  return "file,fault,joint,onset_s,end_s,robot,size,size_unit,viscous,seed,sample_period_s,control_period_s,"
         "duration_s,end_reason\n";
}

std::string label_lines(const SimulationFile& file, const RunSpec& spec, const SimulatedRun& run) {
  const std::string start = csv_cell(spec.name + "." + file.format);
  const std::string end = fmt::format("{},{},{},{},{}\n", spec.seed, spec.simulation.sample_period_s,
                                      spec.simulation.control_period_s,
                                      run.log.rows() ? run.log.time.back() : 0.0, to_string(run.end));
  const std::string robot = csv_cell(file.robot.name);
  if (run.truth.empty()) return fmt::format("{},none,0,,,{},,,,{}", start, robot, end);
  std::string lines;
  for (const SimulatedFault& fault : run.truth) {
    const std::string unit = size_unit(file.robot, fault);
    lines +=
        fmt::format("{},{},{},{},{},{},{},{},{},{}", start, to_string(fault.kind), fault.joint, fault.onset_s,
                    fault.end_s, robot, unit.empty() ? "" : fmt::format("{}", fault.size), unit,
                    describe(fault.kind).size_count > 1 ? fmt::format("{}", fault.viscous) : "", end);
  }
  return lines;
}

}  // namespace faultline
