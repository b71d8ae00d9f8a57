// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/evidence/slow_state.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

/// How large faults are before anything is seen of them: normal priors in SI units, one number a joint. The
/// priors make hypotheses with and without a free size comparable.
struct SizePriors {
  std::vector<double> bias;              ///< rad or m, standard deviation about 0
  std::vector<double> drift;             ///< per second, standard deviation about 0
  std::vector<double> viscous_increase;  ///< N m s/rad or N s/m, mean and standard deviation
  std::vector<double> coulomb_increase;  ///< N m or N, mean and standard deviation
  std::vector<double> external_torque;   ///< N m or N, standard deviation about 0
  double payload = 0.0;                  ///< kg, standard deviation about 0
};

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
  /// rad/(N m) or m/N: by how much the reading of a joint may jump when its torque does, where gears are
  /// springs; one a joint, empty for none.
  std::vector<double> compliance{};
};

/// All that a Kalman filter needs to follow a healthy run of the identified robot.
struct MotionModel {
  Chain<double> chain;
  double torque_phi = 0.0;  ///< torque between samples k and k+1 is tau_k + phi (tau_k+1 - tau_k)
  ProcessNoise noise;
  std::vector<SlowState> slow;  ///< what differs from day to day; at most kMaxSlowStates
  /// s, of rows that are taken in step while their stamps wobble; 0 where stamps are taken as they are.
  double steady_period_s = 0.0;
  double clock_std = 0.0;      ///< s: error of the time stamps, which moves readings by the speed
  std::vector<double> q_std;   ///< measurement noise, rad or m, one a joint; positive
  std::vector<double> dq_std;  ///< rad/s or m/s
  /// By joint: dq of the healthy logs is a difference of q, so it is taken for no measurement; empty for
  /// none.
  std::vector<char> dq_is_difference;
  /// Standard deviations of the innovations of q and dq beyond which healthy rows stray (springs, play,
  /// coarse codes): farther ones count for less, in the filters and in the evidence. One a joint; empty for
  /// none.
  std::vector<double> q_tail, dq_tail;
  std::vector<double> q_low;  ///< range seen in healthy logs
  std::vector<double> q_high;
  std::vector<double> velocity_scale;  ///< root mean square of the healthy velocity
  std::vector<double> torque_scale;    ///< largest healthy torque
  std::vector<double> torque_jump;     ///< largest from one healthy sample to the next; empty for not known
  std::vector<double> inertia_scale;   ///< M_jj in the middle of the range, kg m^2 or kg
  /// Share of healthy samples whose position and velocity repeat the sample before to the last bit, one a
  /// joint.
  std::vector<double> repeat_share;
  std::vector<int> longest_repeat;  ///< longest such run in the healthy logs
  SizePriors priors;

  int joints() const { return chain.joints(); }
  /// Numbers in the state of the healthy filter: q, dq, slow states.
  int healthy_states() const { return 2 * joints() + static_cast<int>(slow.size()); }
};

}  // namespace faultline
