// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/identification.hpp"
#include "lib/identify/weak_form/weak_moments.hpp"

namespace faultline {

/// The model that explains windows it was not fitted to best, and the simplest of those that do it alike.
struct ModelChoice {
  WeakChoice weak;
  std::vector<bool> wanted;         ///< parameters of the space
  std::vector<ModelTerm> terms;     ///< what was tried, in this order
  HeldOutError held_out;            ///< what the other folds' fit leaves of every fold
  std::vector<double> held_out_r2;  ///< by joint
  Eigen::MatrixXd width_doubt;      ///< covariance of the parameters for not knowing the friction widths
  Eigen::MatrixXd spread;  ///< parameters x folds: each fold fitted alone; empty where folds are no logs
};

/// Chooses by cross-validation, joint by joint: the torque's shift, friction width, friction offset and rotor
/// inertia, then the shortest window within one standard error of the best (Breiman et al. 1984).
/// `asked` says which parameters may be free, `optional` which of them must pay for it.
ModelChoice choose_model(const WeakMoments& moments, const ParameterSpace& space,
                         const Eigen::VectorXd& start, const std::vector<bool>& asked,
                         const std::vector<bool>& optional, const ShiftRange& shifts, int sets);

}  // namespace faultline
