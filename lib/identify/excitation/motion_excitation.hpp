// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/excitation/excitation.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/torque_fit.hpp"

namespace faultline {

/// Returns what the motion of the logs determines, by joint and by parameter. `still` are the joints that
/// never move, from 1. Needs `id.joint_fits` and `id.residual_rms`.
Excitation motion_excitation(const TorqueFit& torque, const std::vector<int>& still,
                             const Identification& id);

}  // namespace faultline
