// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/parameter_space.hpp"
#include "lib/identify/torque_fit.hpp"

namespace faultline {

/// A mass or inertia that only joints at rest show is confounded with their stiction: marked in
/// `torque.fit.confounded`. `still` counts joints from 1.
void doubt_still_joints(const ParameterSpace& space, const std::vector<int>& still, TorqueFit& torque);

/// Joints, from 1, whose torque is next to none beside that of the others of their kind, or friction alone.
std::vector<int> undriven_joints(const ParameterSpace& space, const TorqueFit& torque);

/// A link that an undriven joint carries is explained well by no mass at all: what the driven joints alone
/// tell clearly otherwise is marked in `torque.fit.confounded`.
void doubt_undriven_joints(const ParameterSpace& space, const std::vector<int>& undriven, TorqueFit& torque);

/// A rotor and the mass beside it lean on there being no friction offset where an offset, left out because
/// another mixture explains as much, would be mixed with them (m, jr and offset of an axis under gravity):
/// they are marked in `torque.fit.confounded`. Gives those joints, from 1.
std::vector<int> doubt_beside_offsets(const ParameterSpace& space, const Robot& robot, TorqueFit& torque);

}  // namespace faultline
