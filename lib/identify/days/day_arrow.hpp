// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "lib/balance/regress.hpp"

namespace faultline {

/// What one day adds to the normal equations of the robot, its effects eliminated: a block of the arrow that
/// the normal matrix of all days is.
struct DayBlock {
  Eigen::LLT<Eigen::MatrixXd> factor;  ///< of the effects
  Eigen::MatrixXd cross;               ///< effects x parameters
  Eigen::VectorXd vector;              ///< of the effects
  Eigen::MatrixXd robot_matrix;
  Eigen::VectorXd robot_vector;

  /// The day's effects for a robot.
  Eigen::VectorXd effect(const Eigen::VectorXd& robot) const { return factor.solve(vector - cross * robot); }
};

/// `day` has the parameters of the robot first, then the effects of the day, whose prior variance is
/// `between`.
DayBlock day_block(const NormalEquations& day, const Eigen::VectorXd& between);

inline constexpr std::size_t kNoDay = static_cast<std::size_t>(-1);

/// Normal equations of the robot by all days but `left_out`.
NormalEquations robot_sums(const std::vector<DayBlock>& days, std::size_t left_out = kNoDay);

/// Mean and second moments of the effects of all days but `left_out`, their doubt included.
struct EffectMoments {
  Eigen::VectorXd mean, square;

  Eigen::VectorXd about_mean() const { return square - mean.cwiseAbs2(); }
};
EffectMoments effect_moments(const std::vector<DayBlock>& days, const Eigen::VectorXd& robot,
                             std::size_t left_out = kNoDay);

}  // namespace faultline
