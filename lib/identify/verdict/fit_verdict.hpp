// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/identify/gathered.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/torque_fit.hpp"
#include "lib/identify/weak_form/weak_choice.hpp"

namespace faultline {

/// Returns the joints of negligible torque beside another of their kind, or of smaller, almost pure
/// friction torque.
std::vector<Joint> undriven_joints(const TorqueFit& torque);

/// Parameters that the logs do not determine apart from others, although the fit gave them a value.
struct Confounded {
  std::vector<bool> parameters;  ///< those of the fit, and the ones that were found, by parameter
  std::vector<Joint> leaning;    ///< joints whose mass and rotor assume no friction offset
};

/// Finds confounded base parameters beside those of `torque.fit.confounded`:
/// - masses and inertias that only joints at rest (`still`) excite: they are not separable from the
///   stiction;
/// - those of `undriven` joints, to which the driven joints alone give a clearly different value,
///   since zero mass explains the link of an undriven joint well;
/// - a rotor and the masses beside it if a friction offset would be mixed with them (m, jr and offset of a
///   joint under gravity), but was excluded.
Confounded confounded_parameters(const Robot& robot, const std::vector<Joint>& still,
                                 const std::vector<Joint>& undriven, const TorqueFit& torque);

/// Least share of a joint's torque that a valid model explains.
inline constexpr double kExplained = 0.5;

/// Returns the identification with what shows how well its estimate explains the torque: fit by joint and by
/// log, torque delays, the spread between logs, patterns of the residual and trends from log to log. The
/// status stays, unless a joint is below kExplained or a mass is implausible (`unexplained`), or a joint is
/// explained in part (`poorly_explained`). Joints that never move are not judged; those with almost no torque
/// (`undriven`) cannot be `poorly_explained`.
Identification with_verdict(const TorqueFit& torque, const ModelChoice& choice, const Gathered& gathered,
                            const std::vector<Joint>& undriven, Identification id);

/// Tests for a negative inertia, which no real robot has: if the inertia matrix has a negative eigenvalue
/// within the range of the logs, or clearly has one at other angles of the joints, returns `unexplained` with
/// a reason that names the value. Needs `joint_fits`, `estimate` and `covariance`.
std::optional<FitStatus> negative_inertia(const Identification& id);

}  // namespace faultline
