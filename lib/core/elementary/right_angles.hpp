// SPDX-License-Identifier: MIT
#pragma once

namespace faultline::elementary {

/// An angle as `quadrant` right angles plus the rest high + low, within half a right angle of zero.
struct RightAngles {
  int quadrant;  ///< modulo 4
  double high, low;
};

/// Reduces any finite angle, in whole numbers: exact to 2^-135 before it is rounded to the two doubles.
RightAngles right_angles_of_any(double x);

}  // namespace faultline::elementary
