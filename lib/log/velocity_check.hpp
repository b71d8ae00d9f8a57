// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace faultline {

enum class VelocityVerdict {
  not_judged,  ///< too little motion above the noise
  agrees,
  scaled,       ///< proportional to the motion by another factor than 1: a unit or a sign is wrong
  contradicts,  ///< not proportional to the motion
};

/// Agreement of a recorded velocity with the recorded position: change of position = factor * integral of
/// velocity.
struct VelocityAgreement {
  VelocityVerdict verdict = VelocityVerdict::not_judged;
  double factor = 0.0;
  double factor_std = 0.0;  ///< standard deviation of the factor
  double correlation = 0.0;

  /// Whether both surely are one motion, so that the factor has a meaning. The position of a faulty sensor,
  /// which jumps, drifts or sticks, has a lower correlation with the integral of the velocity.
  bool is_one_motion() const;
  /// Whether both are one motion in different units or with opposite signs.
  bool is_other_unit() const { return verdict == VelocityVerdict::scaled && is_one_motion(); }
};

/// Compares the change of one joint's position with the integral of its velocity (trapezoids) over windows of
/// 0.1 s, at least 5 samples; missing values and gaps interrupt a window.
class VelocityCheck {
 public:
  void add(const std::vector<double>& time, const std::vector<double>& q, const std::vector<double>& dq);
  VelocityAgreement result() const;

 private:
  void add_sample(double t, double q, double dq);

  struct Sample {
    double t = 0.0, q = 0.0, dq = 0.0;
  };
  Sample last_, before_last_;
  int run_ = 0;              ///< samples since the last interruption
  double usual_step_ = 0.0;  ///< s
  double window_start_ = 0.0, window_q_ = 0.0, integral_ = 0.0;
  int window_samples_ = 0;
  long long windows_ = 0;
  double xx_ = 0.0, xy_ = 0.0, yy_ = 0.0;  ///< sums over windows; x the integral, y the change of position
  long long differences_ = 0;
  double q_noise_ = 0.0, integral_noise_ = 0.0;  ///< sums of squared second differences
};

}  // namespace faultline
