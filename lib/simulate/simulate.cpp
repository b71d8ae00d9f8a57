// SPDX-License-Identifier: MIT
#include "lib/simulate/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/error.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/simulate/sensors.hpp"

namespace faultline {
namespace {

enum Stream : std::uint64_t { motion_stream = 1, noise_stream = 2, drive_stream = 4 };

constexpr double kBeyondAnyRobot = 1e4;  ///< rad/s or m/s: the simulation diverged

void check_count(const Robot& robot, const std::vector<double>& list, const char* key) {
  if (!list.empty() && static_cast<int>(list.size()) != robot.joints())
    throw Error(ErrorCode::usage, key,
                fmt::format("expected {} numbers, found {}", robot.joints(), list.size()));
}

void check_list(const Robot& robot, const std::vector<double>& list, const char* key) {
  check_count(robot, list, key);
  for (const double value : list)
    if (!(value > 0.0))
      throw Error(ErrorCode::usage, key, fmt::format("expected positive numbers, found {}", value));
}

void check_drives(const Robot& robot, const DriveSpec& drives) {
  check_count(robot, drives.gain, "drives.gain");
  check_count(robot, drives.offset, "drives.offset");
  check_count(robot, drives.roughness, "drives.roughness");
  check_list(robot, drives.roughness_memory_s, "drives.roughness_memory_s");
  for (const double gain : drives.gain)
    if (!(gain > -1.0))
      throw Error(ErrorCode::usage, "drives.gain", fmt::format("expected shares above -1, found {}", gain));
  for (const double roughness : drives.roughness)
    if (!(roughness >= 0.0))
      throw Error(ErrorCode::usage, "drives.roughness",
                  fmt::format("expected numbers that are not negative, found {}", roughness));
}

/// Control periods in a sample period.
int check(const Robot& robot, const SimulationSpec& spec) {
  if (!(spec.control_period_s > 0.0) || !(spec.max_step_s > 0.0) || !(spec.sample_period_s > 0.0))
    throw Error(ErrorCode::usage, "sample_period_s, control_period_s, max_step_s", "expected positive times");
  if (!(spec.duration_s >= spec.sample_period_s) || !(spec.duration_s / spec.sample_period_s < 1e9))
    throw Error(
        ErrorCode::usage, "duration_s",
        fmt::format("expected at least one sample period of {} s and less than 1e9 of them, found {} s",
                    spec.sample_period_s, spec.duration_s));
  const double ratio = spec.sample_period_s / spec.control_period_s;
  if (std::round(ratio) < 1.0 || std::abs(ratio - std::round(ratio)) > 1e-6)
    throw Error(
        ErrorCode::usage, "control_period_s",
        fmt::format("expected a whole number of control periods in the sample period of {} s, found {} s",
                    spec.sample_period_s, spec.control_period_s));
  check_list(robot, spec.torque_limit, "limits.torque");
  check_drives(robot, spec.drives);
  check_list(robot, spec.overspeed, "limits.overspeed");
  for (const FaultEvent& fault : spec.faults) check_fault(robot, fault);
  return static_cast<int>(std::lround(ratio));
}

/// Times of the control ticks. Periods of whole microseconds give the doubles nearest to the decimal times,
/// so that they read 3.953 in a log and not 3.9530000000000003.
class Clock {
 public:
  explicit Clock(double period_s) : period_s_(period_s) {
    const double micro = period_s * 1e6;
    if (std::round(micro) >= 1.0 && std::abs(micro - std::round(micro)) < 1e-6) micro_ = std::round(micro);
  }
  double at(std::int64_t tick) const {
    const auto k = static_cast<double>(tick);
    return micro_ > 0.0 ? k * micro_ / 1e6 : k * period_s_;
  }

 private:
  double period_s_;
  double micro_ = 0.0;
};

std::vector<FaultEvent> real_faults(const Robot& robot, const SimulationSpec& spec) {
  std::vector<FaultEvent> faults;
  for (FaultEvent fault : spec.faults) {
    if (fault.kind == FaultKind::none) continue;
    if (describe(fault.kind).place == FaultPlace::tip) fault.joint = robot.joints();
    faults.push_back(fault);
  }
  std::stable_sort(faults.begin(), faults.end(),
                   [](const FaultEvent& a, const FaultEvent& b) { return a.onset_s < b.onset_s; });
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
  for (int i = 0; i < plant.dq.size(); ++i) {
    if (!(std::abs(plant.dq[i]) < kBeyondAnyRobot)) return EndReason::diverged;
    if (!overspeed.empty() && std::abs(plant.dq[i]) > overspeed[i]) return EndReason::overspeed_trip;
  }
  return EndReason::complete;
}

void finish(SimulatedRun& run, int rows, const std::vector<FaultEvent>& faults) {
  if (rows < run.log.rows()) run.log = slice(run.log, 0, rows);
  if (rows == 0) return;
  const double end = run.log.time.back();
  for (FaultEvent fault : faults) {
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

void check_simulation(const Robot& robot, const SimulationSpec& spec) {
  check(robot, spec);
  const Motion motion(robot, spec.motion, 0.0, 1);
  const Controller controller(robot, spec.controller, spec.control_period_s);
  const Sensors sensors(robot.joints(), spec.noise, {}, Random(1));
  const Plant plant(robot, spec.stops, {}, spec.max_step_s);
}

Motion reference_motion(const Robot& robot, const SimulationSpec& spec, std::uint64_t seed) {
  return {robot, spec.motion, spec.duration_s, Random::stream(seed, motion_stream).bits()};
}

SimulatedRun simulate(const Robot& robot, const SimulationSpec& spec, std::uint64_t seed) {
  const int ticks = check(robot, spec);
  const std::vector<FaultEvent> faults = real_faults(robot, spec);
  const Motion motion = reference_motion(robot, spec, seed);
  const Controller controller(robot, spec.controller, spec.control_period_s);
  Sensors sensors(robot.joints(), spec.noise, faults, Random::stream(seed, noise_stream));
  Drives drives(robot.joints(), spec.drives, Random::stream(seed, drive_stream));
  Plant plant(robot, spec.stops, faults, spec.max_step_s);

  Reference reference;
  motion.at(0.0, reference);
  plant.q = reference.q;
  plant.dq = reference.dq;
  JointVector<double> tau = JointVector<double>::Zero(robot.joints());
  const int rows = static_cast<int>(std::floor(spec.duration_s / spec.sample_period_s + 1e-6)) + 1;
  SimulatedRun run;
  run.log = empty_log(robot, spec, rows);
  const Clock clock(spec.control_period_s);
  std::int64_t tick = 0;
  int row = 0;
  for (; row < rows && run.end == EndReason::complete; ++row) {
    for (int k = 0; k < ticks && run.end == EndReason::complete; ++k, ++tick) {
      const double t = clock.at(tick);
      sensors.read(t, plant.q, plant.dq);
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
  return run;
}

}  // namespace faultline
