// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/parameter_space.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// Which parameters logs may tell.
struct WantedParameters {
  std::vector<bool> asked;  ///< not given exactly, nor friction of a joint that never moves
  std::vector<bool>
      optional;  ///< of those, the ones that must pay on held-out data: rotors, friction offsets
};

/// `still` are the joints that never move, from 1: at rest their friction may be anything up to stiction.
/// Offsets are asked for only with `try_offsets`.
WantedParameters wanted_parameters(const ParameterSpace& space, const Robot& robot,
                                   const std::vector<int>& still, bool try_offsets);

}  // namespace faultline
