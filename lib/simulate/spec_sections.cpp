// SPDX-License-Identifier: MIT
#include "lib/simulate/spec_sections.hpp"

#include <fmt/format.h>

#include <utility>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

void read_span(const TomlTable& table, const std::string& key, double& low, double& high) {
  if (!table.has(key)) return;
  const auto ends = table.is_array(key) ? table.numbers(key, 2) : table.each(key, 2);
  low = ends[0];
  high = ends[1];
}

void read_list(const TomlTable& table, const std::string& key, int joints, std::vector<double>& list) {
  if (table.has(key)) list = table.each(key, joints);
}

NoiseSpec read_noise(const TomlTable& table, int joints, NoiseSpec noise) {
  read_list(table, "q", joints, noise.q);
  read_list(table, "dq", joints, noise.dq);
  read_list(table, "q_resolution", joints, noise.q_resolution);
  return noise;
}

DriveSpec read_drives(const TomlTable& table, int joints, DriveSpec drives) {
  read_list(table, "gain", joints, drives.gain);
  read_list(table, "offset", joints, drives.offset);
  read_list(table, "roughness", joints, drives.roughness);
  read_list(table, "roughness_memory_s", joints, drives.roughness_memory_s);
  return drives;
}

SimulationSpec read_limits(const TomlTable& table, int joints, SimulationSpec spec) {
  read_list(table, "torque", joints, spec.torque_limit);
  read_list(table, "stop_low", joints, spec.stops.low);
  read_list(table, "stop_high", joints, spec.stops.high);
  read_list(table, "overspeed", joints, spec.overspeed);
  return spec;
}

GearSpec read_gears(const TomlTable& table, int joints, GearSpec gears) {
  read_list(table, "stiffness", joints, gears.stiffness);
  read_list(table, "damping", joints, gears.damping);
  read_list(table, "play", joints, gears.play);
  read_list(table, "motor_inertia", joints, gears.motor_inertia);
  return gears;
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
  read_list(table, "torque_resolution", joints, recording.torque_resolution);
  if (table.has("velocity"))
    recording.velocity = table.choice("velocity", {"measured", "difference"}) == "difference"
                             ? RecordedVelocity::difference
                             : RecordedVelocity::measured;
  return recording;
}

}  // namespace

int small_integer(const TomlTable& table, const std::string& key, int fallback) {
  const std::int64_t value = table.integer(key, fallback);
  if (value < 0 || value > 1000)
    table.fail(key, fmt::format("expected a whole number from 0 to 1000, found {}", value));
  return static_cast<int>(value);
}

MotionSpec read_motion(const TomlTable& table, int joints, MotionSpec motion) {
  if (table.has("profile")) {
    const std::string profile = table.choice("profile", {"quintic", "trapezoidal", "step", "fourier"});
    motion.profile = profile == "quintic"       ? MotionProfile::quintic
                     : profile == "trapezoidal" ? MotionProfile::trapezoidal
                     : profile == "step"        ? MotionProfile::step
                                                : MotionProfile::fourier;
  }
  read_list(table, "low", joints, motion.low);
  read_list(table, "high", joints, motion.high);
  read_span(table, "move_s", motion.move_min_s, motion.move_max_s);
  read_span(table, "dwell_s", motion.dwell_min_s, motion.dwell_max_s);
  motion.blend = table.number("blend", motion.blend);
  motion.harmonics = small_integer(table, "harmonics", motion.harmonics);
  motion.fourier_period_s = table.number("fourier_period_s", motion.fourier_period_s);
  if (table.has("points")) motion.points = table.number_rows("points", joints);
  return motion;
}

ControllerSpec read_controller(const TomlTable& table, int joints, std::uint64_t seed,
                               ControllerSpec controller) {
  if (table.has("kind"))
    controller.kind = table.choice("kind", {"computed_torque", "pd_gravity"}) == "pd_gravity"
                          ? ControllerKind::pd_gravity
                          : ControllerKind::computed_torque;
  controller.bandwidth_rad_s = table.number("bandwidth_rad_s", controller.bandwidth_rad_s);
  controller.damping = table.number("damping", controller.damping);
  controller.friction_compensation = table.flag("friction_compensation", controller.friction_compensation);
  read_list(table, "mass_error", joints, controller.mass_error);
  if (!table.has("mass_error_std")) return controller;
  if (table.has("mass_error"))
    table.fail("mass_error_std", "is given together with mass_error; give only one of them");
  const double std = table.number("mass_error_std");
  Random random = Random::stream(seed, 3);
  controller.mass_error.resize(joints);
  for (double& error : controller.mass_error) error = std * random.normal();
  return controller;
}

SimulationSpec read_machine(const TomlTable& file, int joints, SimulationSpec spec) {
  spec.noise = read_noise(file.table("noise"), joints, std::move(spec.noise));
  spec.drives = read_drives(file.table("drives"), joints, std::move(spec.drives));
  spec = read_limits(file.table("limits"), joints, std::move(spec));
  spec.machine.gears = read_gears(file.table("gears"), joints, std::move(spec.machine.gears));
  const TomlTable stick_slip = file.table("stick_slip"), warm_up = file.table("warm_up");
  read_list(stick_slip, "share", joints, spec.machine.stick_slip.share);
  read_list(stick_slip, "speed", joints, spec.machine.stick_slip.speed);
  read_list(warm_up, "share", joints, spec.machine.warm_up.share);
  read_list(warm_up, "time_s", joints, spec.machine.warm_up.time_s);
  spec.work_piece = read_work_piece(file.table("work_piece"), spec.work_piece);
  spec.recording = read_recording(file.table("recording"), joints, std::move(spec.recording));
  return spec;
}

}  // namespace faultline
