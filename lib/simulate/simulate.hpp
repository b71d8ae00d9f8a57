// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "lib/log/log.hpp"
#include "lib/simulate/controller.hpp"
#include "lib/simulate/drives.hpp"
#include "lib/simulate/fault_event.hpp"
#include "lib/simulate/motion.hpp"
#include "lib/simulate/plant.hpp"
#include "lib/simulate/recording.hpp"
#include "lib/simulate/work_piece.hpp"

namespace faultline {

/// Errors of the sensors, one number for each joint; empty: none.
struct NoiseSpec {
  std::vector<double> q{};             ///< standard deviation, rad or m
  std::vector<double> dq{};            ///< standard deviation, rad/s or m/s
  std::vector<double> q_resolution{};  ///< step of the encoder, rad or m; 0: none
};

/// All properties of a simulated run except its robot and its seed.
struct SimulationSpec {
  double duration_s = 10.0;
  double sample_period_s = 0.001;  ///< of the log; a whole multiple of the control period
  /// The torque is held over this time. "held" sets it to the sample period.
  double control_period_s = 0.001;
  /// Longest step of the integration. Stiff friction shortens it to a tenth at most; sharper friction is
  /// widened to fit that step.
  double max_step_s = 0.001;
  MotionSpec motion{};
  ControllerSpec controller{};
  NoiseSpec noise{};
  DriveSpec drives{};
  std::vector<double> torque_limit{};  ///< N m or N, one number for each joint; empty: no limit
  JointStops stops{};
  MachineSpec machine{};            ///< springs and play, friction beyond the model's
  WorkPieceSpec work_piece{};       ///< is picked up and put down, and is no fault
  std::vector<double> overspeed{};  ///< true speed at which the drives trip and the log ends; empty: never
  std::vector<SimulatedFault> faults{};
  RecordingSpec recording{};
  bool record_reference = false;  ///< q_ref and dq_ref in the log
};

enum class EndReason {
  complete,
  overspeed_trip,
  diverged,  ///< a speed left all bounds, as of an unstable control loop; the log ends before
};
const char* to_string(EndReason reason);

/// A simulated log with its faults.
struct SimulatedRun {
  Log log;
  /// The faults in order of onset, with end_s at most the end of the log; empty: a healthy run.
  std::vector<SimulatedFault> truth;
  EndReason end = EndReason::complete;
};

/// Throws Error(usage) naming the key if the spec does not fit the robot.
void check_simulation(const Robot& robot, const SimulationSpec& spec);

/// Returns the reference that simulate() follows with the same robot, spec and seed.
Motion reference_motion(const Robot& robot, const SimulationSpec& spec, std::uint64_t seed);

/// Simulates one run. The log's torque is the commanded one, after the torque limit; its row k is the
/// measurement at k sample periods and the torque that acts from then on, unless `recording` changes it. With
/// compliant gears, positions and speeds are those of the motors. The same robot, spec and seed give the same
/// bytes; motion, noise, drives, work pieces and recording draw from separate streams, so that adding a fault
/// changes none of them. Throws Error(usage) naming the key if the spec does not fit the robot.
SimulatedRun simulate(const Robot& robot, const SimulationSpec& spec, std::uint64_t seed = 1);

}  // namespace faultline
