// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/weak_form/weak_moments.hpp"

namespace faultline {

/// Of the largest torque of joints of the same kind: a joint with less asks for no mass at all.
inline constexpr double kUndrivenShare = 0.05;

/// Judges choices of windows, shifts, widths and terms by what they leave of torque, on held-out data and on
/// all.
class Chooser {
 public:
  /// The three must outlive it; parameters that a fit leaves alone stay at `start`.
  Chooser(const WeakMoments& moments, const ParameterSpace& space, const Eigen::VectorXd& start)
      : moments_(moments), space_(space), start_(start) {}

  /// What a fit leaves of every joint, by which residuals are weighed: none so small that a joint decides
  /// alone, since a joint that is hardly driven is explained best by no mass at all.
  Eigen::VectorXd scale(const WeakChoice& choice, const std::vector<bool>& wanted) const;
  /// Root mean square torque of every joint in the windows that choices are judged by.
  Eigen::VectorXd torque(const WeakChoice& choice) const;
  Eigen::VectorXd fit(const WeakChoice& choice, const std::vector<bool>& wanted,
                      const Eigen::VectorXd& scale) const;
  HeldOutError error(const WeakChoice& choice, const std::vector<bool>& wanted,
                     const Eigen::VectorXd& scale) const {
    return moments_.held_out(choice, wanted, start_, scale, moments_.yardstick());
  }
  /// The same judged by the shortest windows: by what is too quick for the others.
  HeldOutError quick_error(const WeakChoice& choice, const std::vector<bool>& wanted,
                           const Eigen::VectorXd& scale) const {
    return moments_.held_out(choice, wanted, start_, scale, 0);
  }
  /// The same in the choice's own scale.
  HeldOutError error(const WeakChoice& choice, const std::vector<bool>& wanted) const {
    return error(choice, wanted, scale(choice, wanted));
  }
  /// Whether most logs, each fitted alone, are told better by `with` at joint `j`: what only logs together
  /// ask for makes up for how they differ. A single log tells nothing of that.
  bool suits_each(const WeakChoice& without, const WeakChoice& with, const std::vector<bool>& wanted,
                  const Eigen::VectorXd& scale, int j) const;
  /// Square of what is left of all joints together, each in its scale.
  double left(const WeakChoice& choice, const std::vector<bool>& wanted, const Eigen::VectorXd& scale) const;
  /// The shift of joint `j` with which least is left of all joints together.
  int best_shift(WeakChoice choice, const std::vector<bool>& wanted, const Eigen::VectorXd& scale, int j,
                 const ShiftRange& shifts) const;

 private:
  const WeakMoments& moments_;
  const ParameterSpace& space_;
  const Eigen::VectorXd& start_;
};

/// Mean and standard error, over the folds, of the logarithm by which a joint's squared residual shrinks:
/// folds of gentle and of fast motion count alike.
struct Gain {
  double mean = 0.0, error = 0.0;
};

Gain gain_of(const HeldOutError& without, const HeldOutError& with, int joint);

/// What a term must be worth to be kept.
struct Worth {
  double residual = 0.01;  ///< share of its joint's held-out residual,
  double torque = 5e-4;    ///< of the joint's torque: less is of no use to anyone,
  double sure = 1.0;       ///< and standard errors over the folds
};

/// Whether joint `joint`, of torque `torque` rms, is told better by `with` by as much as that.
bool pays(const HeldOutError& without, const HeldOutError& with, int joint, double torque,
          const Worth& worth);

}  // namespace faultline
