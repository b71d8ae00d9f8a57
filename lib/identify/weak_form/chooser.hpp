// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "lib/identify/weak_form/weak_form.hpp"

namespace faultline {

/// Of the largest torque of joints of the same kind: zero mass would best explain a joint with less.
inline constexpr double kUndrivenShare = 0.05;

/// Mean squared torque residual of every joint in each fold, with a fit to the other folds.
struct HeldOutError {
  Eigen::MatrixXd square;  ///< folds x joints, (N m)^2 or N^2
  Eigen::MatrixXd rows;    ///< folds x joints: number of windows in the mean
  Eigen::MatrixXd torque;  ///< folds x joints: mean square torque in them
  Eigen::VectorXd rms() const;
};

/// Judges choices of windows, shifts, widths and terms by their torque residual, held out and over all folds,
/// from second moments of the windows' balances by fold: a fit for any choice then needs one solution,
/// without the windows.
class Chooser {
 public:
  /// `phi` is the torque timing between samples while shifts are compared. Parameters that a fit does not
  /// estimate stay at `start`. The space of the windows and `start` must outlive it.
  Chooser(const WeakSets& windows, double phi, const Eigen::VectorXd& start);

  const ParameterSpace& space() const { return space_; }
  const ShiftRange& shifts() const { return shifts_; }
  int folds() const { return folds_; }
  /// Whether every fold is one log, in their order.
  bool folds_are_logs() const { return folds_are_logs_; }
  /// Returns the set of windows that usually judges choices.
  int yardstick() const { return yardstick_; }

  /// Returns the residual of every joint, N m or N, by which residuals are weighted: bounded below so that no
  /// joint decides alone, since an almost undriven joint is explained best by zero mass.
  Eigen::VectorXd scale(const WeakChoice& choice, const std::vector<bool>& wanted) const;
  /// Returns the rms torque of every joint in the windows that judge choices.
  Eigen::VectorXd torque(const WeakChoice& choice) const;
  /// Returns the standard deviation of every joint's torque in these windows.
  Eigen::VectorXd torque_std(const WeakChoice& choice) const;
  /// Returns the fit to all folds; joint j weighs 1 / scale_j^2.
  Eigen::VectorXd fit(const WeakChoice& choice, const std::vector<bool>& wanted,
                      const Eigen::VectorXd& scale) const;
  /// Returns the fit to one fold alone.
  Eigen::VectorXd fit_one(const WeakChoice& choice, const std::vector<bool>& wanted,
                          const Eigen::VectorXd& scale, int fold) const;
  /// Returns the residual of each fold with fits to the other folds, on the windows that judge choices or, if
  /// `quick`, on the shortest ones: for terms that are too fast for the others.
  HeldOutError error(const WeakChoice& choice, const std::vector<bool>& wanted, const Eigen::VectorXd& scale,
                     bool quick = false) const;
  /// The same in the choice's own scale.
  HeldOutError error(const WeakChoice& choice, const std::vector<bool>& wanted) const {
    return error(choice, wanted, scale(choice, wanted));
  }
  /// Whether `with` explains joint `j` better in most logs, each fitted alone: a term that only all logs
  /// together support may stand for their differences. True if the folds are not single logs.
  bool suits_each(const WeakChoice& without, const WeakChoice& with, const std::vector<bool>& wanted,
                  const Eigen::VectorXd& scale, int j) const;
  /// Returns the summed squared residual of all joints, each in its scale.
  double left(const WeakChoice& choice, const std::vector<bool>& wanted, const Eigen::VectorXd& scale) const;

 private:
  /// Moments of one joint's rows: base, viscous, offset, skew, Coulomb of every width, its extra terms,
  /// torque of every shift.
  struct Moments {
    Eigen::MatrixXd sum;
    double rows = 0.0;
  };

  /// Column of the moments, and the parameter of the space that it belongs to.
  struct Column {
    int at = 0, parameter = 0;
  };

  const Moments& at(int set, int fold, int j) const { return moments_[(set * folds_ + fold) * joints_ + j]; }
  std::vector<Column> columns(const WeakChoice& choice, int j) const;
  int torque_column(const WeakChoice& choice, int j) const;
  int torque_begin(int j) const;
  Eigen::VectorXd fit_folds(const WeakChoice& choice, const std::vector<bool>& wanted,
                            const Eigen::VectorXd& scale, const std::function<bool(int)>& uses) const;
  double squared_residual(const Moments& m, const WeakChoice& choice, const Eigen::VectorXd& parameters,
                          int j) const;
  Eigen::VectorXd residual_rms(const WeakChoice& choice, const Eigen::VectorXd& parameters) const;

  const ParameterSpace& space_;
  const Eigen::VectorXd& start_;
  ShiftRange shifts_;
  int folds_ = 0, joints_ = 0, yardstick_ = 0;
  bool folds_are_logs_ = false;
  std::vector<std::vector<int>> extra_;  ///< by joint: the extra terms that act on it
  std::vector<Moments> moments_;
};

/// Mean and standard error, over the folds, of the logarithm by which a joint's squared residual shrinks:
/// folds of slow and of fast motion count alike.
struct Gain {
  double mean = 0.0, error = 0.0;
};

Gain gain_of(const HeldOutError& without, const HeldOutError& with, int j);

/// Least gain by a term that is kept.
struct LeastGain {
  double residual = 0.01;  ///< of its joint's held-out residual,
  double torque = 5e-4;    ///< of the joint's torque: less is of no practical use,
  double sure = 1.0;       ///< and standard errors over the folds
};

/// Whether `with` explains joint `j`, of torque `torque` rms, better by at least that much.
bool pays(const HeldOutError& without, const HeldOutError& with, int j, double torque,
          const LeastGain& worth);

}  // namespace faultline
