// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/identify/weak_form/weak_system.hpp"

namespace faultline {

/// Mean squared torque residual of every joint in each fold, with a fit to the other folds.
struct HeldOutError {
  Eigen::MatrixXd square;  ///< folds x joints, (N m)^2 or N^2
  Eigen::MatrixXd rows;    ///< folds x joints: number of windows in the mean
  Eigen::MatrixXd torque;  ///< folds x joints: mean square torque in them
  Eigen::VectorXd rms() const;
};

/// Second moments of the windows' balances by fold. A fit for any choice of windows, torque shift, friction
/// width and parameters then needs one solution, without the windows.
class WeakMoments {
 public:
  /// `phi` is the torque timing between samples while shifts are compared.
  WeakMoments(const WeakSets& windows, double phi);

  int folds() const { return folds_; }
  /// Whether every fold is one log, in their order.
  bool folds_are_logs() const { return folds_are_logs_; }
  /// Returns the set of windows that usually judges choices.
  int yardstick() const { return yardstick_; }

  /// Returns the fit to all folds; joint j weighs 1 / scale_j^2.
  Eigen::VectorXd fit(const WeakChoice& choice, const std::vector<bool>& wanted, const Eigen::VectorXd& start,
                      const Eigen::VectorXd& scale) const;
  /// Returns the fit to one fold alone.
  Eigen::VectorXd fit_one(const WeakChoice& choice, const std::vector<bool>& wanted,
                          const Eigen::VectorXd& start, const Eigen::VectorXd& scale, int fold) const;
  /// Returns the summed squared torque residual of a joint in one fold, with a fit to that fold alone.
  double own_fit_residual(const WeakChoice& choice, const std::vector<bool>& wanted,
                          const Eigen::VectorXd& start, const Eigen::VectorXd& scale, int fold,
                          int joint) const;
  /// Returns the rms torque residual of every joint with `parameters` in the chosen windows, all folds.
  Eigen::VectorXd residual_rms(const WeakChoice& choice, const Eigen::VectorXd& parameters) const;
  /// Returns the rms torque of every joint.
  Eigen::VectorXd torque_rms(const WeakChoice& choice) const;
  /// Returns the standard deviation of every joint's torque.
  Eigen::VectorXd torque_std(const WeakChoice& choice) const;
  /// Returns the residual of each fold with fits to the other folds, on the windows of set `judge`.
  HeldOutError held_out(const WeakChoice& choice, const std::vector<bool>& wanted,
                        const Eigen::VectorXd& start, const Eigen::VectorXd& scale, int judge) const;

 private:
  /// Moments of one joint's rows: base, viscous, offset, skew, Coulomb of every width, its extra terms,
  /// torque of every shift.
  struct Moments {
    Eigen::MatrixXd sum;
    double rows = 0.0;
  };

  const Moments& at(int set, int fold, int joint) const {
    return moments_[(set * folds_ + fold) * joints_ + joint];
  }
  std::vector<int> columns(const WeakChoice& choice, int joint) const;
  std::vector<int> parameters_of(int joint) const;
  int torque_begin(int joint) const;
  Eigen::VectorXd fit_folds(const WeakChoice& choice, const std::vector<bool>& wanted,
                            const Eigen::VectorXd& start, const Eigen::VectorXd& scale,
                            const std::vector<bool>& used) const;
  double squared_residual(const Moments& m, const WeakChoice& choice, const Eigen::VectorXd& parameters,
                          int joint) const;

  const ParameterSpace& space_;
  ShiftRange shifts_;
  int folds_ = 0, joints_ = 0, yardstick_ = 0;
  bool folds_are_logs_ = false;
  std::vector<std::vector<int>> extra_;  ///< by joint: the extra terms that act on it
  std::vector<Moments> moments_;
};

}  // namespace faultline
