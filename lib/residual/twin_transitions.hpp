// SPDX-License-Identifier: MIT
#pragma once

#include "lib/residual/transitions.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

/// Simulates `count` transitions of the identified robot from starts scattered around `logged` ones, so that
/// a network also learns the states between and beyond the moves of a few healthy logs, which a faulty robot
/// reaches. Throws nothing; transitions with non-finite results are left out.
Transitions twin_transitions(const Transitions& logged, const TransitionShape& shape, const Chain& chain,
                             int count);

}  // namespace faultline
