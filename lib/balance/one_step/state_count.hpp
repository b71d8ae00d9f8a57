// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <type_traits>

#include "lib/robot/chain.hpp"

namespace faultline {

/// Calls `function` with the number of states (2 to 16, even) as a compile-time constant: with matrices of
/// known size it takes half the time.
template <int kStates = 2, typename Function>
auto with_state_count(int states, const Function& function) {
  if constexpr (kStates < 2 * kMaxJoints)
    if (states > kStates) return with_state_count<kStates + 2>(states, function);
  return function(std::integral_constant<int, kStates>{});
}

}  // namespace faultline
