// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/parameter_space.hpp"
#include "lib/identify/torque_fit.hpp"

namespace faultline {

/// Marks in `torque.fit.confounded` the masses and inertias that only joints at rest excite: they are not
/// separable from the stiction. `still` counts joints from 1.
void mark_unmoved_joints(const ParameterSpace& space, const std::vector<int>& still, TorqueFit& torque);

/// Returns the joints, from 1, of negligible torque beside another of their kind, or of smaller, almost pure
/// friction torque.
std::vector<int> undriven_joints(const ParameterSpace& space, const TorqueFit& torque);

/// Marks in `torque.fit.confounded` the base parameters of undriven joints to which the driven joints alone
/// give a clearly different value: zero mass explains the link of an undriven joint well.
void mark_undriven_joints(const ParameterSpace& space, const std::vector<int>& undriven, TorqueFit& torque);

/// Marks in `torque.fit.confounded` a rotor and the masses beside it if a friction offset would be mixed with
/// them (m, jr and offset of a joint under gravity), but was excluded. Returns those joints, from 1.
std::vector<int> mark_beside_offsets(const ParameterSpace& space, const Robot& robot, TorqueFit& torque);

}  // namespace faultline
