// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

namespace faultline {

/// Unwraps the angle of one joint that a recorder keeps within one turn (-pi to pi or 0 to 2 pi).
class WrappedAngle {
 public:
  /// Returns the unwrapped angle, rad. If `dq` is missing (NaN), the last step predicts this one, provided
  /// that it was a small part of a turn. After a step longer than `longest_s` the path is unknown, and the
  /// number of turns stays.
  double unwrapped(double t, double q, double dq, double longest_s);
  /// Whether the last angle crossed a border of the turn.
  bool has_wrapped() const { return has_wrapped_; }

 private:
  bool begun_ = false, has_wrapped_ = false;
  double t_ = 0.0, q_ = 0.0, dq_ = 0.0;  ///< of the row before, as recorded
  double turns_ = 0.0;
  double step_ = std::numeric_limits<double>::quiet_NaN();  ///< the last one
};

}  // namespace faultline
