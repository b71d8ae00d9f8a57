// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/parameter_space.hpp"
#include "lib/identify/torque_fit.hpp"
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
/// - those of `undriven` joints, from 1, to which the driven joints alone give a clearly different value:
/// zero
///   mass explains the link of an undriven joint well;
/// - a rotor and the masses beside it if a friction offset would be mixed with them (m, jr and offset of a
///   joint under gravity), but was excluded.
Confounded confounded_parameters(const ParameterSpace& space, const Robot& robot,
                                 const std::vector<int>& still, const std::vector<int>& undriven,
                                 const TorqueFit& torque);

}  // namespace faultline
