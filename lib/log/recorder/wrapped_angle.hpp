// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

namespace faultline {

/// Makes one joint's angle, which a recorder keeps within one turn (-pi to pi or 0 to 2 pi), go on beyond.
class WrappedAngle {
 public:
  /// The angle as it goes on. `dq` may be missing (NaN); then the last step says how far the joint goes, if
  /// it was a small part of a turn. After a step longer than `longest_s` nothing is known of the way, and the
  /// angle goes on where it was read.
  double unwrapped(double t, double q, double dq, double longest_s);
  /// Whether the last angle was the first beyond another border of the turn.
  bool has_wrapped() const { return has_wrapped_; }

 private:
  bool begun_ = false, has_wrapped_ = false;
  double t_ = 0.0, q_ = 0.0, dq_ = 0.0;  ///< of the row before, as they were read
  double turns_ = 0.0;
  double step_ = std::numeric_limits<double>::quiet_NaN();  ///< the last one
};

}  // namespace faultline
