// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <type_traits>

#include "lib/robot/chain.hpp"

namespace faultline {

/// Number of states up to which the matrices have a size known at compile time.
inline constexpr int kMostFixedStates = 8;

/// Number of joints for a number of states; both may be Eigen::Dynamic.
template <int kStates>
inline constexpr int kJointsOf = kStates == Eigen::Dynamic ? Eigen::Dynamic : kStates / 2;

/// A matrix that is not stored on the heap; kRows and kColumns may be Eigen::Dynamic, then at most as large
/// as for a robot of kMaxJoints.
template <int kRows, int kColumns>
using SmallMatrix =
    Eigen::Matrix<double, kRows, kColumns, kRows == 1 && kColumns != 1 ? Eigen::RowMajor : Eigen::ColMajor,
                  kRows == Eigen::Dynamic ? 2 * kMaxJoints : kRows,
                  kColumns == Eigen::Dynamic ? 3 * kMaxJoints : kColumns>;

/// Calls `function` with the number of states (2 to 16, even) as a compile-time constant, with which it takes
/// half the time; more than kMostFixedStates are Eigen::Dynamic, since each size takes seconds to compile.
template <int kStates = 2, typename Function>
auto with_state_count(int states, const Function& function) {
  if constexpr (kStates < kMostFixedStates) {
    if (states > kStates) return with_state_count<kStates + 2>(states, function);
  } else {
    if (states > kStates) return function(std::integral_constant<int, Eigen::Dynamic>{});
  }
  return function(std::integral_constant<int, kStates>{});
}

}  // namespace faultline
