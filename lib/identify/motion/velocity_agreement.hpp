// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/identify/motion/motion_smoother.hpp"

namespace faultline {

/// How the measured velocity of a joint goes with the derivative of its position.
struct DerivativeAgreement {
  double factor = 1.0;       ///< measured over derived, by least squares
  double correlation = 1.0;  ///< of both

  /// They are the same quantity in different units or with different signs.
  bool disagrees() const;
};

/// `motion` must have a velocity.
DerivativeAgreement velocity_agreement(const JointMotion& motion);

/// In words, such as "dq1 is 57.3 times the derivative of q1: one of them is in degrees".
std::string words(const DerivativeAgreement& agreement, int joint);

}  // namespace faultline
