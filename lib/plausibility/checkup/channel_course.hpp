// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace faultline {

/// Rows in which a channel kept one value.
struct SameValue {
  std::int64_t rows = 0;
  double value = std::numeric_limits<double>::quiet_NaN();
  double start_s = std::numeric_limits<double>::quiet_NaN();
  double length_s = 0.0;
  double moved = 0.0;  ///< how far the joint moved meanwhile, told by another channel, rad or m
};

/// The step in which a channel's values lie, as that of an encoder or of a printed decimal, from the first
/// few thousand changes of the value.
class ValueStep {
 public:
  void add_change(double change);
  /// Nullopt when the changes are no multiples of one step, or too few.
  std::optional<double> result() const;

 private:
  std::vector<double> changes_;  ///< sizes
};

/// How one channel goes through its values, over the whole log.
class ChannelCourse {
 public:
  /// `rate`: the channel is the rate of the place that add() is told.
  explicit ChannelCourse(bool rate = false) : rate_(rate) {}
  /// `place` is where another channel says that the joint is, rad or m up to a constant; NaN for unknown.
  void add(double t, double value, double place);

  struct Result {
    SameValue longest;           ///< of all stretches of one value
    SameValue while_moving;      ///< the one in which the joint moved farthest
    SameValue at_min, at_max;    ///< longest at the least and the largest value
    std::optional<double> step;  ///< in which the values lie
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
