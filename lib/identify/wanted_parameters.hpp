// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/parameter_space.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// Parameters to be estimated from logs.
struct WantedParameters {
  std::vector<bool> asked;     ///< not given exactly, nor friction of a joint that never moves
  std::vector<bool> optional;  ///< of those, kept only if they lower the held-out error: rotors, offsets,
                               ///< bent, skew and extra terms
};

/// Returns the parameters to be estimated. `still` are the joints that never move, from 1: at rest their
/// friction may be anything up to stiction. Offsets, bends and skews are asked for only with `try_offsets`.
WantedParameters wanted_parameters(const ParameterSpace& space, const Robot& robot,
                                   const std::vector<int>& still, bool try_offsets);

}  // namespace faultline
