// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "lib/balance/regress.hpp"

namespace faultline {

/// Contribution of one day to the normal equations of the robot, after elimination of its effects: one block
/// of the arrow-shaped normal matrix of all days.
struct DayBlock {
  Eigen::LLT<Eigen::MatrixXd> factor;  ///< Cholesky factor of the matrix of the effects
  Eigen::MatrixXd cross;               ///< effects x parameters of the robot
  Eigen::VectorXd vector;              ///< right-hand side of the effects
  Eigen::MatrixXd robot_matrix;
  Eigen::VectorXd robot_vector;

  /// Returns the effects of the day, given the parameters of the robot.
  Eigen::VectorXd effect(const Eigen::VectorXd& robot) const { return factor.solve(vector - cross * robot); }
};

/// Eliminates the effects of a day. `day` has the parameters of the robot first, then the effects of the day,
/// whose prior variance is `between`.
DayBlock day_block(const NormalEquations& day, const Eigen::VectorXd& between);

inline constexpr std::size_t kNoDay = static_cast<std::size_t>(-1);

/// Returns the normal equations of the robot from all days but `left_out`.
NormalEquations robot_sums(const std::vector<DayBlock>& days, std::size_t left_out = kNoDay);

/// Mean and second moments of the effects of all days but `left_out`, their posterior variance included.
struct EffectMoments {
  Eigen::VectorXd mean, square;

  Eigen::VectorXd about_mean() const { return square - mean.cwiseAbs2(); }
};
EffectMoments effect_moments(const std::vector<DayBlock>& days, const Eigen::VectorXd& robot,
                             std::size_t left_out = kNoDay);

}  // namespace faultline
