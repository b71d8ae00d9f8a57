// SPDX-License-Identifier: MIT
#include "apps/work/simulation.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/work/file_use.hpp"
#include "formats/log_writer.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/log/transformed/coupled_source.hpp"
#include "lib/simulate/spec_file.hpp"

namespace faultline {
namespace {

nlohmann::ordered_json summary(const SimulationFile& file, const RunSpec& spec, const SimulatedRun& run) {
  nlohmann::ordered_json faults = nlohmann::ordered_json::array();
  for (const SimulatedFault& fault : run.truth)
    faults.push_back({{"kind", to_string(fault.kind)},
                      {"joint", fault.joint.number()},
                      {"onset_s", fault.onset_s},
                      {"end_s", fault.end_s},
                      {"size", fault.size}});
  return {{"file", spec.name + "." + file.format},
          {"seed", spec.seed},
          {"rows", run.log.rows()},
          {"end_reason", to_string(run.end)},
          {"faults", faults}};
}

std::string log_path(const SimulateRequest& request, const SimulationFile& file, const RunSpec& run) {
  return (std::filesystem::path(request.folder) / (run.name + "." + file.format)).string();
}

std::string labels_path(const SimulateRequest& request) {
  return (std::filesystem::path(request.folder) / "labels.csv").string();
}

void claim_files(const SimulateRequest& request, const SimulationFile& file) {
  FileUse files;
  files.reads("the spec", request.spec).reads("the robot file", file.robot_path);
  for (const RunSpec& run : file.runs)
    files.writes("the run " + run.name + ",", log_path(request, file, run));
  files.writes("the labels,", labels_path(request)).claim();
}

/// Writes pictures first, the pages that refer to them last.
void write_reproduction(const std::filesystem::path& folder, const Reproduction& reproduction,
                        const std::string& json) {
  for (const Figure& figure : reproduction.figures)
    write_file((folder / (figure.id + ".svg")).string(), render_svg(figure.plot));
  write_file((folder / "index.md").string(), reproduction_markdown(reproduction));
  write_file((folder / "index.json").string(), json);
}

}  // namespace

nlohmann::ordered_json simulate_into(const SimulateRequest& request, const Progress& progress) {
  const SimulationFile file = load_simulation_file(request.spec, request.seed);
  claim_files(request, file);
  make_folder(request.folder);
  nlohmann::ordered_json runs = nlohmann::ordered_json::array();
  std::string labels = labels_header();
  for (std::size_t i = 0; i < file.runs.size(); ++i) {
    const RunSpec& spec = file.runs[i];
    if (progress)
      progress("simulate " + spec.name, static_cast<double>(i) / static_cast<double>(file.runs.size()));
    const SimulatedRun run = simulate(file.robot, spec.simulation, spec.seed);
    write_log(log_path(request, file, spec), uncoupled(run.log, file.robot.log.coupling));
    labels += label_lines(file, spec, run);
    runs.push_back(summary(file, spec, run));
  }
  write_file(labels_path(request), labels);
  return {{"schema", "faultline/simulation/1"}, {"robot", file.robot.name}, {"runs", runs}};
}

ReproducedFolder reproduce_into(const std::string& folder, const ReproduceOptions& options,
                                const Progress& progress) {
  options.check();
  make_folder(folder);
  ReproducedFolder out{reproduce(options, progress), {}};
  out.json = reproduction_json(out.reproduction);
  write_reproduction(folder, out.reproduction, out.json);
  return out;
}

}  // namespace faultline
