// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "lib/robot/chain.hpp"

namespace faultline {

/// How one log measures, against what the model's logs did.
struct LogNoise {
  std::array<double, kMaxJoints> q_scale;   ///< noise over that of MotionModel::q_std, by joint
  std::array<double, kMaxJoints> dq_scale;  ///< the same of dq

  std::array<bool, kMaxJoints> dq_is_difference{};  ///< of q: no measurement of its own

  bool has_velocity = true;
  /// A position that repeats may be a joint at rest: the model knows only how often both repeat together.
  bool repeats_say_nothing = false;

  LogNoise() {
    q_scale.fill(1.0);
    dq_scale.fill(1.0);
  }
};

}  // namespace faultline
