// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace faultline {

/// A stretch of rows in which a channel kept one value.
struct SameValue {
  std::int64_t rows = 0;
  double value = std::numeric_limits<double>::quiet_NaN();
  double start_s = std::numeric_limits<double>::quiet_NaN();
  double length_s = 0.0;
  double moved = 0.0;  ///< how far the joint moved meanwhile by another channel, rad or m
};

/// Estimates the step in which a channel's values lie, as for an encoder or a printed decimal, from the first
/// few thousand changes of the value.
class ValueStep {
 public:
  void add_change(double change);
  /// Returns the step; nullopt if the changes are not multiples of one step, or too few.
  std::optional<double> result() const;

 private:
  std::vector<double> changes_;  ///< absolute values
};

/// Follows the values of one channel over the whole log.
class ChannelCourse {
 public:
  /// `rate`: whether the channel is the derivative of `place` in add().
  explicit ChannelCourse(bool rate = false) : rate_(rate) {}
  /// `place`: position of the joint by another channel, rad or m up to a constant; NaN if unknown.
  void add(double t, double value, double place);

  struct Result {
    SameValue longest;           ///< longest stretch of one value
    SameValue while_moving;      ///< the stretch in which the joint moved farthest
    SameValue at_min, at_max;    ///< longest ones at the least and the largest value
    std::optional<double> step;  ///< between possible values
  };
  Result result() const;

 private:
  void begin(double t, double value, double place);
  void end();

  bool rate_ = false;
  double last_ = std::numeric_limits<double>::quiet_NaN();
  SameValue now_;
  double place_ = std::numeric_limits<double>::quiet_NaN();  ///< at the start of now_
  Result found_;
  ValueStep step_;
};

}  // namespace faultline
