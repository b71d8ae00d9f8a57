// SPDX-License-Identifier: MIT
#include "lib/simulate/spec_file.hpp"

#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <set>
#include <utility>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/open_ending.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/robot/nearest_word.hpp"
#include "lib/robot/robot_file.hpp"
#include "lib/simulate/spec_sections.hpp"

namespace faultline {
namespace {

SimulatedFault read_fault(const TomlTable& table, const Robot& robot) {
  SimulatedFault fault;
  std::vector<std::string> kinds;
  for (int k = 0; k < kFaultKinds; ++k) kinds.emplace_back(to_string(static_cast<FaultKind>(k)));
  fault.kind = fault_kind_from(table.choice("kind", kinds));
  fault.joint =
      small_integer(table, "joint", describe(fault.kind).place == FaultPlace::link ? robot.joints() : 0);
  fault.onset_s = table.number("onset_s", 0.0);
  if (!table.has("onset_s") && fault.kind != FaultKind::none) table.number("onset_s");
  if (table.has("end_s") && table.has("duration_s"))
    table.fail("duration_s", "is given together with end_s; give only one of them");
  fault.end_s = table.number("end_s", fault.end_s);
  if (table.has("duration_s")) fault.end_s = fault.onset_s + table.number("duration_s");
  fault.size = table.number("size", 0.0);
  fault.viscous = table.number("viscous", 0.0);
  try {
    check_fault(robot, fault);
  } catch (const Error& error) {
    const std::string key = error.where().substr(error.where().find('.') + 1);
    table.fail(table.has(key) ? key : "", table.has(key) ? error.message() : error.what());
  }
  return fault;
}

std::vector<SimulatedFault> read_faults(const TomlTable& table, const Robot& robot,
                                        std::vector<SimulatedFault> faults) {
  if (!table.has("fault")) return faults;
  faults.clear();
  if (table.is_array("fault"))
    for (const TomlTable& one : table.tables("fault")) faults.push_back(read_fault(one, robot));
  else
    faults.push_back(read_fault(table.table("fault"), robot));
  return faults;
}

/// A simulation as far as it is read. "held" of the file applies to runs with a period of their own, too.
struct ReadSimulation {
  SimulationSpec spec;
  bool held = false;  ///< the control period is the sample period
};

/// Reads the keys that the file and each of its runs share; those of a run take precedence.
ReadSimulation read_simulation(const TomlTable& table, const Robot& robot, std::uint64_t seed,
                               ReadSimulation simulation) {
  auto& [spec, held] = simulation;
  const int joints = robot.joints();
  spec.duration_s = table.number("duration_s", spec.duration_s);
  spec.sample_period_s = table.number("sample_period_s", spec.sample_period_s);
  if (table.is_text("control_period_s")) {
    table.choice("control_period_s", {"held"});
    held = true;
  } else if (table.has("control_period_s")) {
    spec.control_period_s = table.number("control_period_s");
    held = false;
  }
  if (held) spec.control_period_s = spec.sample_period_s;
  spec.max_step_s = table.number("max_step_s", spec.max_step_s);
  spec.record_reference = table.flag("record_reference", spec.record_reference);
  spec.motion = read_motion(table.table("motion"), joints, std::move(spec.motion));
  spec.controller = read_controller(table.table("controller"), joints, seed, std::move(spec.controller));
  spec = read_machine(table, joints, std::move(spec));
  spec.faults = read_faults(table, robot, std::move(spec.faults));
  return simulation;
}

Robot read_robot(const TomlTable& table, const std::string& folder) {
  if (!table.has("robot"))
    table.fail("",
               "the key robot is missing; expected the path of a robot file, axes such as \"RRP\" or a "
               "[robot] table");
  if (table.is_table("robot")) return robot_from_table(table.table("robot"));
  return load_robot_file(table.text("robot"), folder);
}

std::string run_name(const TomlTable& table, std::set<std::string>& taken) {
  const std::string name = table.text("name");
  for (const char c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-' && c != '.')
      table.fail("name", fmt::format("expected letters, digits, _ - and ., found \"{}\"", name));
  if (name.empty() || name[0] == '.')
    table.fail("name", "expected a name that is not empty and does not start with a dot");
  if (!taken.insert(name).second) table.fail("name", fmt::format("\"{}\" is the name of two runs", name));
  return name;
}

std::uint64_t read_seed(const TomlTable& table, std::uint64_t fallback) {
  const std::int64_t seed = table.integer("seed", static_cast<std::int64_t>(fallback));
  if (seed < 0)
    table.fail("seed", fmt::format("expected a whole number that is not negative, found {}", seed));
  return static_cast<std::uint64_t>(seed);
}

}  // namespace

SimulationFile simulation_from_toml(const std::string& text, const std::string& where,
                                    const std::string& folder, const SimulationFileOptions& options) {
  const TomlTable table = TomlTable::parse(text, where);
  SimulationFile file;
  file.robot = read_robot(table, folder);
  if (!table.is_table("robot"))
    file.robot_path = (std::filesystem::path(folder) / table.text("robot")).string();
  if (table.has("format")) file.format = table.choice("format", {"csv", "flog"});
  std::uint64_t seed = read_seed(table, 1);
  if (options.override_seed) seed = options.seed;
  const auto runs = table.tables("run");
  if (runs.empty()) {
    const std::string near = nearest_word("run", table.keys());
    table.fail("", "has no [[run]]; expected at least one, with a name" +
                       (near.empty() ? "" : fmt::format(". Is \"{}\" a misspelling of it?", near)));
  }
  std::set<std::string> taken;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    RunSpec run;
    run.name = run_name(runs[i], taken);
    run.seed = read_seed(runs[i], seed + i);
    ReadSimulation of_file = read_simulation(table, file.robot, run.seed, {});
    run.simulation = read_simulation(runs[i], file.robot, run.seed, std::move(of_file)).spec;
    try {
      check_simulation(file.robot, run.simulation);
    } catch (const Error& error) {
      runs[i].fail("", fmt::format("run \"{}\" cannot be simulated: {}", run.name, error.what()));
    }
    file.runs.push_back(std::move(run));
  }
  table.finish();
  return file;
}

SimulationFile load_simulation_file(const std::string& path, const SimulationFileOptions& options) {
  const std::string text = read_file(path);
  refuse_open_number(text, path);
  return simulation_from_toml(text, path, std::filesystem::path(path).parent_path().string(), options);
}

}  // namespace faultline
