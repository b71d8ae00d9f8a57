// SPDX-License-Identifier: MIT
#include "lib/simulate/simulation_check.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/error.hpp"
#include "lib/simulate/joint_list.hpp"

namespace faultline {
namespace {

void check_times(const SimulationSpec& spec) {
  if (!(spec.control_period_s > 0.0) || !(spec.max_step_s > 0.0) || !(spec.sample_period_s > 0.0))
    throw Error(ErrorCode::usage, "sample_period_s, control_period_s, max_step_s", "expected positive times");
  if (!(spec.duration_s >= spec.sample_period_s) || !(spec.duration_s / spec.sample_period_s < 1e9))
    throw Error(
        ErrorCode::usage, "duration_s",
        fmt::format("expected at least one sample period of {} s and less than 1e9 of them, found {} s",
                    spec.sample_period_s, spec.duration_s));
  control_periods_per_sample(spec);
}

void check_noise(int joints, const NoiseSpec& noise) {
  check_not_negative(joints, noise.q, "noise.q");
  check_not_negative(joints, noise.dq, "noise.dq");
  check_not_negative(joints, noise.q_resolution, "noise.q_resolution");
}

void check_drives(int joints, const DriveSpec& drives) {
  check_count(joints, drives.gain, "drives.gain");
  check_count(joints, drives.offset, "drives.offset");
  check_not_negative(joints, drives.roughness, "drives.roughness");
  check_positive(joints, drives.roughness_memory_s, "drives.roughness_memory_s");
  for (const double gain : drives.gain)
    if (!(gain > -1.0))
      throw Error(ErrorCode::usage, "drives.gain", fmt::format("expected shares above -1, found {}", gain));
}

}  // namespace

int control_periods_per_sample(const SimulationSpec& spec) {
  const double ratio = spec.sample_period_s / spec.control_period_s;
  if (std::round(ratio) < 1.0 || std::abs(ratio - std::round(ratio)) > 1e-6)
    throw Error(
        ErrorCode::usage, "control_period_s",
        fmt::format("expected a whole number of control periods in the sample period of {} s, found {} s",
                    spec.sample_period_s, spec.control_period_s));
  return static_cast<int>(std::lround(ratio));
}

void check_numbers(const Robot& robot, const SimulationSpec& spec) {
  const int joints = robot.joints();
  check_times(spec);
  check_noise(joints, spec.noise);
  check_positive(joints, spec.torque_limit, "limits.torque");
  check_drives(joints, spec.drives);
  check_positive(joints, spec.overspeed, "limits.overspeed");
  check_gears(robot, spec.machine.gears);
  check_stick_slip(joints, spec.machine.stick_slip);
  check_warm_up(joints, spec.machine.warm_up);
  check_work_piece(spec.work_piece);
  check_recording(joints, spec.sample_period_s, spec.recording);
  for (const SimulatedFault& fault : spec.faults) check_fault(robot, fault);
}

void check_simulation(const Robot& robot, const SimulationSpec& spec) {
  check_numbers(robot, spec);
  const Motion motion(robot, spec.motion, 0.0, 1);
  const Controller controller(robot, spec.controller, spec.control_period_s);
  const Plant plant(robot, spec.stops, {}, spec.max_step_s, spec.machine);
}

}  // namespace faultline
