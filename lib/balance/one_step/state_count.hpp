// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <type_traits>

#include "lib/robot/chain.hpp"

namespace faultline {

/// Calls `function` with the number of states (2 to 16, even) as a constant: matrices of a size that the
/// compiler knows take half the time.
template <typename Function>
auto with_state_count(int states, const Function& function) {
  static_assert(kMaxJoints == 8);
  switch (states / 2) {
    case 1:
      return function(std::integral_constant<int, 2>{});
    case 2:
      return function(std::integral_constant<int, 4>{});
    case 3:
      return function(std::integral_constant<int, 6>{});
    case 4:
      return function(std::integral_constant<int, 8>{});
    case 5:
      return function(std::integral_constant<int, 10>{});
    case 6:
      return function(std::integral_constant<int, 12>{});
    case 7:
      return function(std::integral_constant<int, 14>{});
    default:
      return function(std::integral_constant<int, 16>{});
  }
}

}  // namespace faultline
