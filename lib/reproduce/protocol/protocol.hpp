// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

#include "lib/fault/fault_kind.hpp"
#include "lib/log/log.hpp"
#include "lib/residual/transitions.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

struct ControllerSpec;

/// The controller that the paper does not state, in three readings.
enum class ControllerVariant {
  held,  ///< computed torque, quintic moves, the torque constant over each sample of 73 ms
  fast,  ///< the same at 1 kHz, logged every 73 ms
  pd,    ///< PD and gravity compensation at 1 kHz after step set-points, logged every 73 ms
};
inline constexpr ControllerVariant kControllerVariants[] = {ControllerVariant::held, ControllerVariant::fast,
                                                            ControllerVariant::pd};
inline constexpr int kControllers = static_cast<int>(std::size(kControllerVariants));
const char* to_string(ControllerVariant controller);

/// The paper's "variance = 0.01" has no unit. As a standard deviation in shares of half the range of each
/// position and velocity it may be 0.01 or, read as a variance, 0.1.
inline constexpr double kNoiseVariants[] = {0.0, 0.01, 0.1};

inline constexpr double kSamplePeriod = 0.073;   ///< s, the paper's
inline constexpr double kControlPeriod = 0.001;  ///< s, of fast and pd
ControllerSpec controller_spec(ControllerVariant controller);

/// m = (1, 0.8, 0.5) kg, l = (1, 0.8) m, axes RRP: the paper gives no masses or lengths. Without friction, as
/// in its simulation, or with some in every joint.
Robot bench_robot();
Robot bench_robot_with_friction();

/// Half the range of each signal, by which the paper normalises: rad or m, and per s; N m or N.
struct HalfRanges {
  Eigen::VectorXd q, dq, tau;

  Eigen::VectorXd state() const;  ///< of q, then of dq
};
/// Of healthy motion under this controller: of q as asked for, of dq and tau as found in 100 trajectories of
/// 25 samples, the size of the paper's training set.
HalfRanges half_ranges(const Robot& robot, ControllerVariant controller);

/// What all draws of one experiment share.
struct Experiment {
  Robot robot;  ///< the true one
  ControllerVariant controller = ControllerVariant::held;
  HalfRanges ranges;  ///< of that robot under that controller
  std::uint64_t seed = 1;
};
Experiment experiment_on(const Robot& robot, ControllerVariant controller, std::uint64_t seed);

/// A fault that acts from `onset_s` on; none by default.
struct ActingFault {
  FaultLabel label{};
  double onset_s = 0.0;
};

/// A random move of 1.2 to 1.8 s between two points of the ranges (q1, q2 within 2 rad, q3 -0.35 to 0.05 m),
/// then rest: `samples` + 1 rows from its start, without noise.
Log trajectory(const Robot& robot, ControllerVariant controller, int samples, std::uint64_t seed,
               const ActingFault& fault = {});

/// How long a run is, and how it is logged.
struct RunOfMoves {
  double duration_s = 0.0;
  double sample_period_s = kSamplePeriod;
  ActingFault fault{};
};

/// A run of such moves, each followed by a rest of up to 0.4 s, without noise. Ends early when a freed robot
/// runs away. Readings whose torque changes every millisecond may be logged faster than the paper does.
Log run_of_moves(const Robot& robot, ControllerVariant controller, const RunOfMoves& run, std::uint64_t seed);
/// Share of the samples of such a run within which a move begins, on average.
double share_with_a_start();

/// Adds white noise of `sigma` half ranges to q and dq: measurement noise as in the paper's second test sets.
/// The controller does not see it.
void add_noise(Log& log, const HalfRanges& ranges, double sigma, std::uint64_t seed);

/// The transitions of one sample period in each log, joined. `torque_phi` as in TransitionShape.
Transitions transitions_of(const std::vector<Log>& logs, double torque_phi = 0.0);
TransitionShape one_sample(int joints, double torque_phi = 0.0);

/// What seeds are drawn for. Different purposes never share a stream, so no training set meets a test set.
enum class SeedUse : std::uint64_t {
  generator_training,
  generator_test,
  classifier_training,
  classifier_test,
  run_training,
  run_tuning,
  run_test,
  figures,
  ranges,
  learning_logs,
};
/// The seed of item `index` for this use within experiment `seed`.
std::uint64_t seed_of(std::uint64_t seed, SeedUse use, std::uint64_t index = 0);

inline constexpr int kFaultClasses = 4;  ///< in the order of the outputs: free joint 1, 2, 3, and no fault
inline constexpr int kPatternsPerTrajectory = 10;
inline constexpr int kTable1Trajectories = 90;

/// The output (0 to 3) that a trajectory of the paper's table 1 belongs to: of 1-20 a free joint 1, 21-40
/// joint 2, 41-75 joint 3, 76-90 no fault. `index` counts from 0 to 89.
int table_1_class(int index);
/// What each class is: a free-swinging joint, or none.
FaultLabel fault_of_class(int output);
/// Share of each class in table 1.
Eigen::Vector4d table_1_prior();

/// Patterns of single samples with their truth.
struct FaultPatterns {
  std::array<Transitions, kFaultClasses> of_class;

  int count() const;
};

/// How patterns are made. The default is the paper's training set.
struct FaultTrajectories {
  int count = kTable1Trajectories;
  double sigma = 0.0;       ///< measurement noise, half ranges
  double torque_phi = 0.0;  ///< as in TransitionShape
};

/// Trajectories of ten samples in the order and mix of table 1, the fault there from the start. Use
/// classifier_training or classifier_test.
FaultPatterns fault_patterns(const Experiment& experiment, const FaultTrajectories& trajectories,
                             SeedUse use);

}  // namespace faultline
