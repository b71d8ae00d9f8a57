// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include "lib/evidence/filter/gaussian_state.hpp"
#include "lib/evidence/motion_model.hpp"
#include "lib/evidence/slow_estimate.hpp"

namespace faultline {

/// A slow state that left its normal range so far behind that it is no condition any more.
struct SlowFault {
  SlowEstimate estimate;  ///< when it was farthest
  double from_s = 0.0;    ///< when it was last no more than identified for all the log told, or the first row
  double left_s =
      0.0;  ///< when its whole interval had left the normal range: the fault began between the two
  double alarm_s = 0.0;
  double end_s = 0.0;  ///< last row at which its whole interval was outside
};

/// Watches the friction of a healthy robot's filter for what is too slow for the bank of hypotheses: a state
/// that the filter follows, out of the range in which healthy days are. Other slow states share with each
/// other what one of them does, and are no such evidence.
class SlowWatch {
 public:
  explicit SlowWatch(const MotionModel& model);

  /// The filter's state after the row at `time_s`.
  void take(const GaussianState& state, double time_s);
  /// By alarm.
  const std::vector<SlowFault>& faults() const { return faults_; }

 private:
  static constexpr double kNever = std::numeric_limits<double>::quiet_NaN();

  /// Where a state is on its way out.
  struct Course {
    SlowState state;
    int index = 0;  ///< in the filter's state
    double within_s = kNever, left_s = kNever, far_s = kNever;
    int fault = -1;  ///< in faults_, while it lasts
  };

  void follow(Course& course, double value, double std, double time_s);

  std::vector<Course> courses_;
  std::vector<SlowFault> faults_;
};

}  // namespace faultline
