// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/evidence/hypothesis.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

/// What the identified robot does not know of its own torque, as white noise in torque space. The spectral
/// density of joint j is correlation_s ((torque_share tau_j)^2 + (rest_share fc_j)^2 near rest + floor_j^2)
/// plus dt (step_share |tau step|)^2 for what the torque did between two samples.
/// The defaults are where matching to the healthy logs starts.
struct ProcessNoise {
  double torque_share = 0.005;
  double rest_share = 0.1;      ///< of the Coulomb friction, where |dq| is within some friction widths
  double step_share = 0.3;      ///< 0 when the torque is known to be held
  double correlation_s = 0.02;  ///< s, for which what the model misses stays the same: fixed, not matched
  std::vector<double> floor;    ///< N m or N, one a joint
};

/// All that a Kalman filter needs to follow a healthy run of the identified robot.
struct MotionModel {
  Chain<double> chain;
  double torque_phi = 0.0;  ///< torque between samples k and k+1 is tau_k + phi (tau_k+1 - tau_k)
  ProcessNoise noise;
  std::vector<double> q_std;   ///< measurement noise, rad or m, one a joint; positive
  std::vector<double> dq_std;  ///< rad/s or m/s
  std::vector<double> q_low;   ///< range seen in healthy logs
  std::vector<double> q_high;
  std::vector<double> velocity_scale;  ///< root mean square of the healthy velocity
  std::vector<double> torque_scale;    ///< largest healthy torque
  std::vector<double> inertia_scale;   ///< M_jj in the middle of the range, kg m^2 or kg
  /// Share of healthy samples whose position and velocity repeat the sample before to the last bit, one a
  /// joint.
  std::vector<double> repeat_share;
  std::vector<int> longest_repeat;  ///< longest such run in the healthy logs
  SizePriors priors;

  int joints() const { return chain.joints(); }
};

}  // namespace faultline
