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

/// What the sensors add to the truth, one each a joint; empty: nothing.
struct NoiseSpec {
  std::vector<double> q{};             ///< standard deviation, rad or m
  std::vector<double> dq{};            ///< standard deviation, rad/s or m/s
  std::vector<double> q_resolution{};  ///< step of the encoder, rad or m; 0: none
};

/// Everything about a simulated run but its robot and its seed.
struct SimulationSpec {
  double duration_s = 10.0;
  double sample_period_s = 0.001;  ///< of the log; a whole multiple of the control period
  /// The torque is held over this. Equal to the sample period, it is "held" in the log's terms.
  double control_period_s = 0.001;
  /// Of the integration. Stiff friction shortens it, to a tenth at most; sharper friction is smoothed to
  /// that.
  double max_step_s = 0.001;
  MotionSpec motion{};
  ControllerSpec controller{};
  NoiseSpec noise{};
  DriveSpec drives{};
  std::vector<double> torque_limit{};  ///< N m or N, one each a joint; empty: none
  JointStops stops{};
  MachineSpec machine{};            ///< springs and play, friction beyond the model's
  WorkPieceSpec work_piece{};       ///< comes and goes and is no fault
  std::vector<double> overspeed{};  ///< true speed at which the drives trip and the log ends; empty: never
  std::vector<SimulatedFault> faults{};
  RecordingSpec recording{};
  bool record_reference = false;  ///< q_ref and dq_ref in the log
};

enum class EndReason {
  complete,
  overspeed_trip,
  diverged,  ///< the motion left all bounds (a controller that does not hold this robot); the log ends before
};
const char* to_string(EndReason reason);

/// A simulated log with its truth.
struct SimulatedRun {
  Log log;
  /// The faults that happened, in order of onset, end_s at most the end of the log; empty: a healthy run.
  std::vector<SimulatedFault> truth;
  EndReason end = EndReason::complete;
};

/// Throws Error(usage) naming the key when the spec does not fit the robot.
void check_simulation(const Robot& robot, const SimulationSpec& spec);

/// The reference that simulate() follows with the same robot, spec and seed.
Motion reference_motion(const Robot& robot, const SimulationSpec& spec, std::uint64_t seed);

/// Simulates one run. The log's torque is the commanded one, after the torque limit; its row k is the reading
/// at k sample periods and the torque that acts from then on, unless `recording` says otherwise. Positions
/// and speeds are those of the motors where gears give way. The same robot, spec and seed give the same
/// bytes; motion, noise, drives, work pieces and recording draw from separate streams, so that adding a fault
/// changes none of them. Throws Error(usage) naming the key when the spec does not fit the robot.
SimulatedRun simulate(const Robot& robot, const SimulationSpec& spec, std::uint64_t seed = 1);

}  // namespace faultline
