// SPDX-License-Identifier: MIT
#include "lib/identify/days/day_arrow.hpp"

#include <Eigen/Cholesky>

namespace faultline {

using Eigen::MatrixXd;
using Eigen::VectorXd;

DayBlock day_block(const NormalEquations& day, const VectorXd& between) {
  const Eigen::Index effects = between.size(), robot = day.vector.size() - effects;
  MatrixXd own = day.matrix.bottomRightCorner(effects, effects);
  own.diagonal() += between.cwiseInverse();
  DayBlock out{Eigen::LLT<MatrixXd>(own),
               day.matrix.bottomLeftCorner(effects, robot),
               day.vector.tail(effects),
               {},
               {}};
  out.robot_matrix =
      day.matrix.topLeftCorner(robot, robot) - out.cross.transpose() * out.factor.solve(out.cross);
  out.robot_vector = day.vector.head(robot) - out.cross.transpose() * out.factor.solve(out.vector);
  return out;
}

NormalEquations robot_sums(const std::vector<DayBlock>& days, std::size_t left_out) {
  const Eigen::Index count = days.front().robot_vector.size();
  NormalEquations out{MatrixXd::Zero(count, count), VectorXd::Zero(count)};
  for (std::size_t d = 0; d < days.size(); ++d) {
    if (d == left_out) continue;
    out.matrix += days[d].robot_matrix;
    out.vector += days[d].robot_vector;
  }
  return out;
}

EffectMoments effect_moments(const std::vector<DayBlock>& days, const VectorXd& robot, std::size_t left_out) {
  const Eigen::Index effects = days.front().vector.size();
  EffectMoments out{VectorXd::Zero(effects), VectorXd::Zero(effects)};
  double count = 0.0;
  for (std::size_t d = 0; d < days.size(); ++d) {
    if (d == left_out) continue;
    const VectorXd effect = days[d].effect(robot);
    out.mean += effect;
    out.square += effect.cwiseAbs2() + days[d].factor.solve(MatrixXd::Identity(effects, effects)).diagonal();
    count += 1.0;
  }
  out.mean /= count;
  out.square /= count;
  return out;
}

}  // namespace faultline
