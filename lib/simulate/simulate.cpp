// SPDX-License-Identifier: MIT
#include "lib/simulate/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lib/core/random.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/robot/chain.hpp"
#include "lib/simulate/joint_list.hpp"
#include "lib/simulate/recording.hpp"

namespace faultline {
namespace {

/// Random streams of a run; spec files use 3 for the controller's mass errors.
enum Stream : std::uint64_t {
  motion_stream = 1,
  noise_stream = 2,
  drive_stream = 4,
  work_piece_stream = 5,
  recording_stream = 6
};

constexpr double kBeyondAnyRobot = 1e4;  ///< rad/s or m/s, above which the simulation has diverged

/// Returns the control periods in a sample period. Throws Error(usage) if that is no whole number.
int control_periods_per_sample(const SimulationSpec& spec) {
  const double ratio = spec.sample_period_s / spec.control_period_s;
  if (std::round(ratio) < 1.0 || std::abs(ratio - std::round(ratio)) > 1e-6)
    bad_value(
        "control_period_s",
        fmt::format("expected a whole number of control periods in the sample period of {} s, found {} s",
                    spec.sample_period_s, spec.control_period_s));
  return static_cast<int>(std::lround(ratio));
}

void check_times(const SimulationSpec& spec) {
  if (!(spec.control_period_s > 0.0) || !(spec.max_step_s > 0.0) || !(spec.sample_period_s > 0.0))
    bad_value("sample_period_s, control_period_s, max_step_s", "expected positive times");
  if (!(spec.duration_s >= spec.sample_period_s) || !(spec.duration_s / spec.sample_period_s < 1e9))
    bad_value("duration_s",
              fmt::format("expected at least one sample period of {} s and less than 1e9 of them, found {} s",
                          spec.sample_period_s, spec.duration_s));
  control_periods_per_sample(spec);
}

void check_drives(int joints, const DriveSpec& drives) {
  check_count(joints, drives.gain, "drives.gain");
  check_count(joints, drives.offset, "drives.offset");
  check_not_negative(joints, drives.roughness, "drives.roughness");
  check_positive(joints, drives.roughness_memory_s, "drives.roughness_memory_s");
  check_positive(joints, drives.limit, "drives.limit");
  for (const double gain : drives.gain)
    if (!(gain > -1.0)) bad_value("drives.gain", fmt::format("expected shares above -1, found {}", gain));
}

/// Makes the checks of check_simulation() that no constructor makes.
void check_numbers(const Robot& robot, const SimulationSpec& spec) {
  const int joints = robot.joints();
  check_times(spec);
  check_not_negative(joints, spec.noise.q, "noise.q");
  check_not_negative(joints, spec.noise.dq, "noise.dq");
  check_not_negative(joints, spec.noise.q_resolution, "noise.q_resolution");
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

std::vector<SimulatedFault> real_faults(const Robot& robot, const SimulationSpec& spec) {
  std::vector<SimulatedFault> faults;
  for (SimulatedFault fault : spec.faults) {
    if (fault.kind == FaultKind::none) continue;
    if (describe(fault.kind).place == FaultPlace::link && fault.joint.is_none())
      fault.joint = Joint::at(robot.joints() - 1);
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

/// Measures the true motion for the controller and the log: adds noise, encoder steps and sensor faults,
/// which thereby act through the feedback.
class Sensors {
 public:
  Sensors(int joints, const NoiseSpec& noise, const std::vector<SimulatedFault>& faults, Random random)
      : q_noise_(or_all(noise.q, joints, 0.0)),
        dq_noise_(or_all(noise.dq, joints, 0.0)),
        resolution_(or_all(noise.q_resolution, joints, 0.0)),
        random_(random) {
    for (const SimulatedFault& fault : faults)
      if (describe(fault.kind).acts_on == FaultActsOn::sensor) faults_.push_back(fault);
    q = dq = JointVector::Zero(joints);
  }

  /// Measures at time t; `q` and `dq` keep the values until the next call (a stuck encoder repeats them).
  void read(double t, const JointVector& true_q, const JointVector& true_dq) {
    for (int i = 0; i < q.size(); ++i) {
      double position = true_q[i], speed = true_dq[i];
      bool stuck = false;
      for (const SimulatedFault& fault : faults_) {
        if (fault.joint != Joint::at(i) || t < fault.onset_s || t >= fault.end_s) continue;
        const MachineFault change = machine_fault(fault);
        position += change.reading_offset + change.reading_drift_per_s * (t - fault.onset_s);
        stuck = stuck || change.reading_sticks;
      }
      if (q_noise_[i] > 0.0) position += q_noise_[i] * random_.normal();
      if (dq_noise_[i] > 0.0) speed += dq_noise_[i] * random_.normal();
      if (resolution_[i] > 0.0) position = resolution_[i] * std::round(position / resolution_[i]);
      if (stuck && started_) continue;
      q[i] = position;
      dq[i] = speed;
    }
    started_ = true;
  }

  JointVector q, dq;

 private:
  std::vector<double> q_noise_, dq_noise_, resolution_;
  std::vector<SimulatedFault> faults_;
  Random random_;
  bool started_ = false;
};

/// Inputs and output of the controller at one time.
struct ControlTick {
  double time_s = 0.0;
  const Sensors& sensors;
  const JointVector& tau;
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
  const JointVector& drives = plant.motor_dq();
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
  static constexpr std::array kNames{"complete", "overspeed_trip", "diverged"};
  static_assert(kNames.size() == static_cast<std::size_t>(EndReason::diverged) + 1);
  return kNames[static_cast<std::size_t>(reason)];
}

void check_simulation(const Robot& robot, const SimulationSpec& spec) {
  check_numbers(robot, spec);
  const Motion motion(robot, spec.motion, 0.0, 1);
  const Controller controller(robot, spec.controller, spec.control_period_s);
  const Plant plant(robot, spec.stops, {}, spec.max_step_s, spec.machine);
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
  std::vector<SimulatedFault> changes =
      carried(spec.work_piece, joints, spec.duration_s, Random::stream(seed, work_piece_stream));
  changes.insert(changes.begin(), faults.begin(), faults.end());
  Plant plant(robot, spec.stops, changes, spec.max_step_s, spec.machine);

  Reference reference;
  motion.at(0.0, reference);
  plant.start(reference.q, reference.dq);
  JointVector tau = JointVector::Zero(joints);
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
