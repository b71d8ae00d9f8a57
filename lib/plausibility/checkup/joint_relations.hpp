// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

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

  explicit VelocityRelation(double period_s) : period_s_(period_s) {}
  void add(double t, double q, double dq);
  VelocityRelated result() const;

 private:
  static constexpr int kDelays = 2 * kMostRows + 1;
  void compare();
  bool is_of_steps() const;

  double period_s_;
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

/// Relation of a recorded torque to the acceleration of its joint.
struct TorqueRelated {
  /// Partial correlation with the joint's own acceleration, given all other motion, at the best delay; NaN:
  /// not judged.
  double correlation = std::numeric_limits<double>::quiet_NaN();
  double explained = std::numeric_limits<double>::quiet_NaN();  ///< share of the torque that motion explains
  /// Rows by which the torque is logged late. A torque held until the next row is half a row early.
  double delay_rows = std::numeric_limits<double>::quiet_NaN();
  double delay_uncertainty_rows = std::numeric_limits<double>::quiet_NaN();  ///< uncertainty
  double inertia = std::numeric_limits<double>::quiet_NaN();  ///< about: torque per acceleration

  /// Least size of the correlation that surely shows the sign and the delay of a torque; effects of other
  /// joints and of friction stay below it.
  static constexpr double kClear = 0.6;
  bool is_against_acceleration() const { return correlation < -kClear; }
};

/// Regresses the torques on accelerations, velocities, their products and directions of all joints; positions
/// are differentiated and torques smoothed over the same 30 ms or so.
class TorqueRelation {
 public:
  static constexpr int kMostStrides = 6;  ///< of delay, late or early
  static constexpr int kMostJoints = 8;

  TorqueRelation(int joints, double period_s);
  /// Adds row `row` of positions and torques, [joint][row].
  void add(double t, const std::vector<std::vector<double>>& q, const std::vector<std::vector<double>>& tau,
           std::size_t row);
  /// Returns the relation of each joint.
  std::vector<TorqueRelated> result() const;

 private:
  static constexpr int kDelays = 2 * kMostStrides + 1;
  /// State of the smoothing of one joint's signals.
  struct Smoothed {
    std::vector<double> q, tau, means;  ///< rings of the last 2 half_ + 1, half_ and half_
    double tau_sum = 0.0, mean_sum = 0.0, smooth = 0.0;
  };
  void restart();
  void take();
  TorqueRelated related(int j, const Eigen::MatrixXd& inverse) const;

  int joints_;
  double period_s_;
  std::size_t half_;     ///< rows of half the smoothing
  std::int64_t stride_;  ///< rows between two that are used
  double t_ = 0.0;
  std::int64_t run_ = 0;  ///< samples since the last interruption
  std::vector<Smoothed> smoothed_;
  Eigen::VectorXd acceleration_, velocity_, torque_;  ///< latest, all at one time
  Eigen::MatrixXd motions_, torques_;                 ///< of the last strides, the latest first
  std::int64_t taken_ = 0, count_ = 0;
  Eigen::MatrixXd products_;           ///< of the motion regressors
  std::vector<Eigen::MatrixXd> with_;  ///< by delay: motion x torque
  Eigen::MatrixXd squares_;            ///< joint x delay
  Eigen::VectorXd sums_;               ///< of torques
};

}  // namespace faultline
