// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace faultline {

/// Relation of a recorded velocity to the differences of the recorded position.
struct VelocityRelated {
  double rms = std::numeric_limits<double>::quiet_NaN();          ///< of the velocity; NaN: not judged
  double rms_ratio = std::numeric_limits<double>::quiet_NaN();    ///< velocity to differences
  double noise_share = std::numeric_limits<double>::quiet_NaN();  ///< about, of the differences' mean square
  double delay_rows = std::numeric_limits<double>::quiet_NaN();   ///< rows by which the velocity is late
  bool is_difference = false;  ///< contains the noise of the position: computed from it
};

/// Compares the velocity of one joint with (q_i - q_i-1) / (t_i - t_i-1) at several delays.
class VelocityRelation {
 public:
  static constexpr int kMostRows = 8;  ///< of delay, late or early

  /// A step longer than `gap_s` interrupts the comparison.
  explicit VelocityRelation(double gap_s) : gap_s_(gap_s) {}
  void add(double t, double q, double dq);
  VelocityRelated result() const;

 private:
  static constexpr int kDelays = 2 * kMostRows + 1;
  void compare();
  bool is_of_steps() const;

  double gap_s_ = 0.0;
  double t_ = 0.0, q_ = 0.0;
  std::int64_t run_ = 0;                                 ///< samples since the last interruption
  std::array<double, kDelays> slopes_{}, velocities_{};  ///< the latest first
  std::int64_t count_ = 0;
  double velocity_squares_ = 0.0, slope_squares_ = 0.0, product_ = 0.0, roughness_ = 0.0;
  std::array<double, kDelays> off_{};  ///< squares of velocity minus slope; delay = index - kMostRows
  double off_centred_ = 0.0;           ///< of velocity minus the mean of the slopes before and after
  /// Of steps of position, not divided by time: for velocities that were computed with another clock.
  std::array<double, kDelays> steps_{};
  std::array<double, 2> step_squares_{}, step_products_{};  ///< of one step, of two
  double step_roughness_ = 0.0;
};

}  // namespace faultline
