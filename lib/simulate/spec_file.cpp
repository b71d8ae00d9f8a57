// SPDX-License-Identifier: MIT
#include "lib/simulate/spec_file.hpp"

#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <set>
#include <utility>

#include "lib/core/atomic_file.hpp"
#include "lib/core/csv_cell.hpp"
#include "lib/core/error.hpp"
#include "lib/core/random.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/robot/nearest_word.hpp"
#include "lib/robot/robot_file.hpp"
#include "lib/robot/toml/toml_table.hpp"

namespace faultline {
namespace {

// Readers of the sections; absent keys keep the values of the spec given. check_simulation() checks the
// values against each other and the robot.

/// Returns a whole number from 0 to 1000, for joints and counts.
int small_integer(const TomlTable& table, const std::string& key, int fallback) {
  const std::int64_t value = table.integer(key, fallback);
  if (value < 0 || value > 1000)
    table.fail(key, fmt::format("expected a whole number from 0 to 1000, found {}", value));
  return static_cast<int>(value);
}

void read_span(const TomlTable& table, const std::string& key, double& low, double& high) {
  if (!table.has(key)) return;
  const auto ends = table.is_array(key) ? table.numbers(key, 2) : table.each(key, 2);
  low = ends[0];
  high = ends[1];
}

/// A key and the list that it sets, one number for each joint.
struct KeyedList {
  const char* key;
  std::vector<double>& list;
};

void read_lists(const TomlTable& table, int joints, std::initializer_list<KeyedList> lists) {
  for (const auto& [key, list] : lists)
    if (table.has(key)) list = table.each(key, joints);
}

WorkPieceSpec read_work_piece(const TomlTable& table, WorkPieceSpec piece) {
  piece.mass = table.number("mass", piece.mass);
  read_span(table, "carried_s", piece.carried_min_s, piece.carried_max_s);
  read_span(table, "empty_s", piece.empty_min_s, piece.empty_max_s);
  return piece;
}

RecordingSpec read_recording(const TomlTable& table, int joints, RecordingSpec recording) {
  recording.jitter_s = table.number("jitter_s", recording.jitter_s);
  recording.stamp_resolution_s = table.number("stamp_resolution_s", recording.stamp_resolution_s);
  recording.lost = table.number("lost", recording.lost);
  recording.torque_late_rows = small_integer(table, "torque_late_rows", recording.torque_late_rows);
  recording.velocity_filter_s = table.number("velocity_filter_s", recording.velocity_filter_s);
  read_lists(table, joints, {{"torque_resolution", recording.torque_resolution}});
  if (table.has("velocity"))
    recording.velocity = table.choice("velocity", {"measured", "difference"}) == "difference"
                             ? RecordedVelocity::difference
                             : RecordedVelocity::measured;
  return recording;
}

MotionSpec read_motion(const TomlTable& table, int joints, MotionSpec motion) {
  if (table.has("profile")) {
    const std::string profile = table.choice("profile", {"quintic", "trapezoidal", "step", "fourier"});
    motion.profile = profile == "quintic"       ? MotionProfile::quintic
                     : profile == "trapezoidal" ? MotionProfile::trapezoidal
                     : profile == "step"        ? MotionProfile::step
                                                : MotionProfile::fourier;
  }
  read_lists(table, joints, {{"low", motion.low}, {"high", motion.high}});
  read_span(table, "move_s", motion.move_min_s, motion.move_max_s);
  read_span(table, "dwell_s", motion.dwell_min_s, motion.dwell_max_s);
  motion.blend = table.number("blend", motion.blend);
  motion.harmonics = small_integer(table, "harmonics", motion.harmonics);
  motion.fourier_period_s = table.number("fourier_period_s", motion.fourier_period_s);
  if (table.has("points")) motion.points = table.number_rows("points", joints);
  return motion;
}

/// `seed` draws the errors for `mass_error_std`.
ControllerSpec read_controller(const TomlTable& table, int joints, std::uint64_t seed,
                               ControllerSpec controller) {
  if (table.has("kind"))
    controller.kind = table.choice("kind", {"computed_torque", "pd_gravity"}) == "pd_gravity"
                          ? ControllerKind::pd_gravity
                          : ControllerKind::computed_torque;
  controller.bandwidth_rad_s = table.number("bandwidth_rad_s", controller.bandwidth_rad_s);
  controller.damping = table.number("damping", controller.damping);
  controller.friction_compensation = table.flag("friction_compensation", controller.friction_compensation);
  read_lists(table, joints, {{"mass_error", controller.mass_error}});
  if (!table.has("mass_error_std")) return controller;
  if (table.has("mass_error"))
    table.fail("mass_error_std", "is given together with mass_error; give only one of them");
  const double std = table.number("mass_error_std");
  Random random = Random::stream(seed, 3);
  controller.mass_error.resize(joints);
  for (double& error : controller.mass_error) error = std * random.normal();
  return controller;
}

/// Reads [noise], [drives], [limits], [gears], [stick_slip], [warm_up], [work_piece], [recording] of `file`.
SimulationSpec read_machine(const TomlTable& file, int joints, SimulationSpec spec) {
  auto& [gears, stick_slip, warm_up] = spec.machine;
  DriveSpec& drives = spec.drives;
  read_lists(file.table("noise"), joints,
             {{"q", spec.noise.q}, {"dq", spec.noise.dq}, {"q_resolution", spec.noise.q_resolution}});
  read_lists(file.table("drives"), joints,
             {{"gain", drives.gain},
              {"offset", drives.offset},
              {"roughness", drives.roughness},
              {"roughness_memory_s", drives.roughness_memory_s},
              {"limit", drives.limit}});
  read_lists(file.table("limits"), joints,
             {{"torque", spec.torque_limit},
              {"stop_low", spec.stops.low},
              {"stop_high", spec.stops.high},
              {"overspeed", spec.overspeed}});
  read_lists(file.table("gears"), joints,
             {{"stiffness", gears.stiffness},
              {"damping", gears.damping},
              {"play", gears.play},
              {"motor_inertia", gears.motor_inertia}});
  read_lists(file.table("stick_slip"), joints, {{"share", stick_slip.share}, {"speed", stick_slip.speed}});
  read_lists(file.table("warm_up"), joints, {{"share", warm_up.share}, {"time_s", warm_up.time_s}});
  spec.work_piece = read_work_piece(file.table("work_piece"), spec.work_piece);
  spec.recording = read_recording(file.table("recording"), joints, std::move(spec.recording));
  return spec;
}

SimulatedFault read_fault(const TomlTable& table, const Robot& robot) {
  SimulatedFault fault;
  std::vector<std::string> kinds;
  for (int k = 0; k < kFaultKinds; ++k) kinds.emplace_back(to_string(static_cast<FaultKind>(k)));
  fault.kind = fault_kind_from(table.choice("kind", kinds));
  fault.joint = Joint::numbered(
      small_integer(table, "joint", describe(fault.kind).place == FaultPlace::link ? robot.joints() : 0));
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
                                    const std::string& folder, std::optional<std::uint64_t> seed) {
  const TomlTable table = TomlTable::parse(text, where);
  SimulationFile file;
  file.robot = read_robot(table, folder);
  if (!table.is_table("robot"))
    file.robot_path = (std::filesystem::path(folder) / table.text("robot")).string();
  if (table.has("format")) file.format = table.choice("format", {"csv", "flog"});
  const std::uint64_t first_seed = seed.value_or(read_seed(table, 1));
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
    run.seed = read_seed(runs[i], first_seed + i);
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

SimulationFile load_simulation_file(const std::string& path, std::optional<std::uint64_t> seed) {
  const std::string text = read_file(path);
  refuse_open_number(text, path);
  return simulation_from_toml(text, path, std::filesystem::path(path).parent_path().string(), seed);
}

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
