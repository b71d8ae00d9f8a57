// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/identification.hpp"
#include "lib/identify/weak_form/chooser.hpp"

namespace faultline {

/// The model with the least error on held-out windows, and the simplest of those that are equally good.
struct ModelChoice {
  WeakChoice weak;
  std::vector<bool> wanted;          ///< parameters of the space
  std::vector<ModelTerm> terms;      ///< terms that were tried, in this order
  HeldOutError held_out;             ///< residual of every fold with the fit to the other folds
  std::vector<double> held_out_r2;   ///< by joint
  Eigen::MatrixXd width_covariance;  ///< covariance of the parameters due to unknown friction widths
  Eigen::MatrixXd spread;  ///< parameters x folds: each fold fitted alone; empty if folds are not logs
};

/// Chooses by cross-validation, joint by joint: the torque's shift, friction width, friction offset, rotor
/// inertia and rarer terms, then the shortest window within one standard error of the best (Breiman et al.
/// 1984). `phi` and `start` are those of Chooser.
ModelChoice choose_model(const WeakSets& windows, double phi, const Eigen::VectorXd& start,
                         const WantedParameters& parameters);

/// Returns the choice with those extra terms of `asked` that lower the error on held-out data, the most
/// promising first. Cosine and sine of a ripple, viscous and Coulomb friction of a shared drive go together.
ModelChoice choose_extra(const Chooser& chooser, const std::vector<bool>& asked, ModelChoice choice);

/// Returns the choice with the gains of torques that are logged too large or too small by a factor: those of
/// joints that contradict the torques of the other joints unless scaled. The first joint of `counts` is the
/// reference. `counts`: joints to be used.
ModelChoice choose_gains(const Chooser& chooser, const std::vector<bool>& counts, ModelChoice choice);

}  // namespace faultline
