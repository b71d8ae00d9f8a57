// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace faultline {

/// Measurement noise and process noise of one joint's motion.
struct MotionNoise {
  double q_std = 0.0;         ///< of a measured position, rad or m
  double dq_std = 0.0;        ///< of a measured velocity, rad/s or m/s; 0 if none is measured
  double jerk_density = 0.0;  ///< spectral density of the white jerk that drives it, (rad/s^3)^2 s
};

/// Measurements of one joint. Rows whose `q_off` or `dq_off` is 1 do not count.
struct JointMotion {
  Eigen::VectorXd time;   ///< s, increasing
  Eigen::VectorXd q, dq;  ///< `dq` is empty if it is not measured
  Eigen::VectorXi q_off, dq_off;

  int rows() const { return static_cast<int>(time.size()); }
};

struct SmoothMotion {
  Eigen::VectorXd q, dq;
};

/// Returns position and velocity of a motion driven by white jerk, given all its measurements (fixed-interval
/// smoother; Rauch, Tung and Striebel 1965). Needs two rows.
SmoothMotion smooth_motion(const JointMotion& motion, const MotionNoise& noise);

/// Returns the noise of maximum likelihood, at least that of the quantisation of the values.
MotionNoise fit_motion_noise(const JointMotion& motion);

}  // namespace faultline
