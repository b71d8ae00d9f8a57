// SPDX-License-Identifier: MIT
#include "lib/simulate/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/fault/fault_catalogue.hpp"
#include "lib/simulate/clock.hpp"
#include "lib/simulate/sensors.hpp"
#include "lib/simulate/simulation_check.hpp"

namespace faultline {
namespace {

/// 3 is that of the controller's mass errors in spec files.
enum Stream : std::uint64_t {
  motion_stream = 1,
  noise_stream = 2,
  drive_stream = 4,
  work_piece_stream = 5,
  recording_stream = 6
};

constexpr double kBeyondAnyRobot = 1e4;  ///< rad/s or m/s: the simulation diverged

std::vector<SimulatedFault> real_faults(const Robot& robot, const SimulationSpec& spec) {
  std::vector<SimulatedFault> faults;
  for (SimulatedFault fault : spec.faults) {
    if (fault.kind == FaultKind::none) continue;
    if (describe(fault.kind).place == FaultPlace::link && fault.joint == 0) fault.joint = robot.joints();
    faults.push_back(fault);
  }
  std::stable_sort(faults.begin(), faults.end(),
                   [](const SimulatedFault& a, const SimulatedFault& b) { return a.onset_s < b.onset_s; });
  return faults;
}

Log empty_log(const Robot& robot, const SimulationSpec& spec, int rows) {
  Log like, log;
  like.q.resize(robot.joints());
  like.dq = like.tau = like.q;
  if (spec.record_reference) like.q_ref = like.dq_ref = like.q;
  resize_like(log, like, rows);
  return log;
}

/// What a controller sees and does at one moment.
struct ControlTick {
  double time_s = 0.0;
  const Sensors& sensors;
  const JointVector<double>& tau;
  const Reference& reference;
};

void record(Log& log, int row, const ControlTick& tick) {
  log.time[row] = tick.time_s;
  for (int i = 0; i < log.joints(); ++i) {
    log.q[i][row] = tick.sensors.q[i];
    log.dq[i][row] = tick.sensors.dq[i];
    log.tau[i][row] = tick.tau[i];
    if (log.q_ref.empty()) continue;
    log.q_ref[i][row] = tick.reference.q[i];
    log.dq_ref[i][row] = tick.reference.dq[i];
  }
}

EndReason state_of(const Plant& plant, const std::vector<double>& overspeed) {
  const JointVector<double>& drives = plant.motor_dq();
  for (int i = 0; i < plant.dq.size(); ++i) {
    if (!(std::abs(plant.dq[i]) < kBeyondAnyRobot && std::abs(drives[i]) < kBeyondAnyRobot))
      return EndReason::diverged;
    if (!overspeed.empty() && std::abs(drives[i]) > overspeed[i]) return EndReason::overspeed_trip;
  }
  return EndReason::complete;
}

void finish(SimulatedRun& run, int rows, const std::vector<SimulatedFault>& faults) {
  if (rows < run.log.rows()) run.log = slice(run.log, 0, rows);
  if (rows == 0) return;
  const double end = run.log.time.back();
  for (SimulatedFault fault : faults) {
    if (fault.onset_s > end) continue;
    fault.end_s = std::min(fault.end_s, end);
    run.truth.push_back(fault);
  }
}

}  // namespace

const char* to_string(EndReason reason) {
  switch (reason) {
    case EndReason::complete:
      return "complete";
    case EndReason::overspeed_trip:
      return "overspeed_trip";
    case EndReason::diverged:
      return "diverged";
  }
  return "unknown";
}

Motion reference_motion(const Robot& robot, const SimulationSpec& spec, std::uint64_t seed) {
  return {robot, spec.motion, spec.duration_s, Random::stream(seed, motion_stream).bits()};
}

SimulatedRun simulate(const Robot& robot, const SimulationSpec& spec, std::uint64_t seed) {
  check_numbers(robot, spec);
  const int ticks = control_periods_per_sample(spec), joints = robot.joints();
  const std::vector<SimulatedFault> faults = real_faults(robot, spec);
  const Motion motion = reference_motion(robot, spec, seed);
  const Controller controller(with_motors(robot, spec.machine.gears), spec.controller, spec.control_period_s);
  Sensors sensors(joints, spec.noise, faults, Random::stream(seed, noise_stream));
  Drives drives(joints, spec.drives, Random::stream(seed, drive_stream));
  std::vector<SimulatedFault> changes = faults;
  for (const SimulatedFault& piece :
       carried(spec.work_piece, joints, spec.duration_s, Random::stream(seed, work_piece_stream)))
    changes.push_back(piece);
  Plant plant(robot, spec.stops, changes, spec.max_step_s, spec.machine);

  Reference reference;
  motion.at(0.0, reference);
  plant.start(reference.q, reference.dq);
  JointVector<double> tau = JointVector<double>::Zero(joints);
  const int rows = static_cast<int>(std::floor(spec.duration_s / spec.sample_period_s + 1e-6)) + 1;
  SimulatedRun run;
  run.log = empty_log(robot, spec, rows);
  const Clock clock(spec.control_period_s);
  std::int64_t tick = 0;
  int row = 0;
  for (; row < rows && run.end == EndReason::complete; ++row) {
    for (int k = 0; k < ticks && run.end == EndReason::complete; ++k, ++tick) {
      const double t = clock.at(tick);
      sensors.read(t, plant.motor_q(), plant.motor_dq());
      motion.at(t, reference);
      controller.torque(reference, sensors.q, sensors.dq, tau);
      for (std::size_t i = 0; i < spec.torque_limit.size(); ++i)
        tau[i] = std::clamp(tau[i], -spec.torque_limit[i], spec.torque_limit[i]);
      if (k == 0) record(run.log, row, {t, sensors, tau, reference});
      drives.act(spec.control_period_s, tau);
      plant.advance(t, clock.at(tick + 1), tau);
      run.end = state_of(plant, spec.overspeed);
    }
  }
  finish(run, row, faults);
  run.log = recorded(std::move(run.log), spec.recording, spec.sample_period_s,
                     Random::stream(seed, recording_stream));
  return run;
}

}  // namespace faultline
