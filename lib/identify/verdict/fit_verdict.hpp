// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/excitation/excitation.hpp"
#include "lib/identify/gathered.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/identify/torque_fit.hpp"
#include "lib/identify/verdict/parameter_trend.hpp"
#include "lib/identify/verdict/residual_pattern.hpp"
#include "lib/identify/weak_form/weak_choice.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// Returns the joints, from 1, of negligible torque beside another of their kind, or of smaller, almost pure
/// friction torque.
std::vector<int> undriven_joints(const ParameterSpace& space, const TorqueFit& torque);

/// Parameters that the logs do not determine apart from others, although the fit gave them a value.
struct Confounded {
  std::vector<bool> parameters;  ///< those of the fit, and the ones that were found, by parameter
  std::vector<int> leaning;      ///< joints, from 1, whose mass and rotor assume no friction offset
};

/// Finds confounded base parameters beside those of `torque.fit.confounded`:
/// - masses and inertias that only joints at rest (`still`, from 1) excite: they are not separable from the
///   stiction;
/// - those of `undriven` joints, from 1, to which the driven joints alone give a clearly different value,
///   since zero mass explains the link of an undriven joint well;
/// - a rotor and the masses beside it if a friction offset would be mixed with them (m, jr and offset of a
///   joint under gravity), but was excluded.
Confounded confounded_parameters(const ParameterSpace& space, const Robot& robot,
                                 const std::vector<int>& still, const std::vector<int>& undriven,
                                 const TorqueFit& torque);

/// Delays of the torques, s, by joint.
struct TorqueDelays {
  std::vector<double> whole_s;     ///< whole samples, for the robot; empty if all are 0
  std::vector<double> relative_s;  ///< with the timing, relative to a straight line between samples
};

/// Least share of a joint's torque that a valid model explains.
inline constexpr double kExplained = 0.5;

/// How well an estimate explains the torque. The fields with a namesake in Identification mean the same.
struct FitVerdict {
  FitStatus status;
  std::vector<double> residual_rms, fit_r2;
  std::vector<std::vector<double>> log_r2;  ///< by log, then by joint: IdentifiedLog::fit_r2
  TorqueDelays delays;
  std::vector<double> between_logs_std;
  std::vector<JointFit> joint_fits;
  std::vector<ResidualPattern> residual_patterns;
  Excitation excitation;
  std::vector<ParameterTrend> trends;
};

/// Judges how well `id.estimate` explains the torque: fit by joint and by log, torque delays, the spread
/// between logs, patterns of the residual and trends from log to log. The status is that of `id`, unless a
/// joint is below kExplained or a mass is implausible (`unexplained`), or a joint is explained in part
/// (`poorly_explained`). Joints that never move (`still`, from 1) are not judged; those with almost no torque
/// (`undriven`) cannot be `poorly_explained`.
FitVerdict judge_fit(const TorqueFit& torque, const ModelChoice& choice, const Gathered& gathered,
                     const std::vector<int>& still, const std::vector<int>& undriven,
                     const Identification& id);

/// Returns the identification with the fields of its verdict.
Identification with_verdict(Identification id, FitVerdict verdict);

}  // namespace faultline
