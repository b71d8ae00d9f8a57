// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/weak_form/weak_moments.hpp"

namespace faultline {

/// Of the largest torque of joints of the same kind: zero mass would best explain a joint with less.
inline constexpr double kUndrivenShare = 0.05;

/// Judges choices of windows, shifts, widths and terms by their torque residual, held out and over all folds.
class Chooser {
 public:
  /// The three must outlive it; parameters that a fit does not estimate stay at `start`.
  Chooser(const WeakMoments& moments, const ParameterSpace& space, const Eigen::VectorXd& start)
      : moments_(moments), space_(space), start_(start) {}

  /// Returns the residual of every joint, N m or N, by which residuals are weighted: bounded below so that no
  /// joint decides alone, since an almost undriven joint is explained best by zero mass.
  Eigen::VectorXd scale(const WeakChoice& choice, const std::vector<bool>& wanted) const;
  /// Returns the rms torque of every joint in the windows that judge choices.
  Eigen::VectorXd torque(const WeakChoice& choice) const;
  Eigen::VectorXd fit(const WeakChoice& choice, const std::vector<bool>& wanted,
                      const Eigen::VectorXd& scale) const;
  HeldOutError error(const WeakChoice& choice, const std::vector<bool>& wanted,
                     const Eigen::VectorXd& scale) const {
    return moments_.held_out(choice, wanted, start_, scale, moments_.yardstick());
  }
  /// The same, judged by the shortest windows: for terms that are too fast for the others.
  HeldOutError quick_error(const WeakChoice& choice, const std::vector<bool>& wanted,
                           const Eigen::VectorXd& scale) const {
    return moments_.held_out(choice, wanted, start_, scale, 0);
  }
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
  /// Returns the shift of joint `j` with the smallest such sum.
  int best_shift(WeakChoice choice, const std::vector<bool>& wanted, const Eigen::VectorXd& scale, int j,
                 const ShiftRange& shifts) const;

 private:
  const WeakMoments& moments_;
  const ParameterSpace& space_;
  const Eigen::VectorXd& start_;
};

/// Mean and standard error, over the folds, of the logarithm by which a joint's squared residual shrinks:
/// folds of slow and of fast motion count alike.
struct Gain {
  double mean = 0.0, error = 0.0;
};

Gain gain_of(const HeldOutError& without, const HeldOutError& with, int joint);

/// Least gain by a term that is kept.
struct LeastGain {
  double residual = 0.01;  ///< of its joint's held-out residual,
  double torque = 5e-4;    ///< of the joint's torque: less is of no practical use,
  double sure = 1.0;       ///< and standard errors over the folds
};

/// Whether `with` explains joint `joint`, of torque `torque` rms, better by at least that much.
bool pays(const HeldOutError& without, const HeldOutError& with, int joint, double torque,
          const LeastGain& worth);

}  // namespace faultline
