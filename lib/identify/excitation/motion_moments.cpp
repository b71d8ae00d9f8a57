// SPDX-License-Identifier: MIT
#include "lib/identify/excitation/motion_moments.hpp"

#include <cmath>
#include <limits>

#include "lib/core/matrix/decompositions.hpp"
#include "lib/identify/weak_form/weak_windows.hpp"

namespace faultline {
namespace {

constexpr double kStep_s = 0.02;       // between samples of a motion, whose fastest harmonic lasts 0.7 s
constexpr double kWindow_s = 0.16;     // as long as the windows that judge the terms of logs (kYardstick_s)
constexpr int kManyWindows = 1 << 20;  // none is dropped
constexpr double kRank = 1e-13;        // of the largest eigenvalue

Stretch stretch_of(const Motion& reference, int joints, double duration_s) {
  const int rows = static_cast<int>(std::lround(duration_s / kStep_s)) + 1;
  Stretch s;
  s.period_s = kStep_s;
  s.time.resize(rows);
  s.q_smooth.resize(joints, rows);
  s.dq_smooth.resize(joints, rows);
  s.tau.setZero(joints, rows);
  s.outlier.setZero(2 * joints, rows);
  Reference at;
  for (int k = 0; k < rows; ++k) {
    s.time[k] = k * kStep_s;
    reference.at(s.time[k], at);
    s.q_smooth.col(k) = at.q;
    s.dq_smooth.col(k) = at.dq;
  }
  s.q = s.q_smooth;
  s.dq = s.dq_smooth;
  return s;
}

/// Row of joint `j` in all linear parameters of the space but the offsets and the timing.
Eigen::RowVectorXd row_of(const ParameterSpace& space, const WeakWindow& w, int j) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(space.linear());
  row.head(space.rigid()) = w.base.row(j);
  row[space.viscous(j)] = w.viscous[j];
  row[space.coulomb(j)] = w.coulomb(j, kOwnWidth);
  return row;
}

}  // namespace

Eigen::MatrixXd motion_moments(const ParameterSpace& space, const Excitation& of, const Motion& reference,
                               double duration_s) {
  const Stretch stretch = stretch_of(reference, space.joints(), duration_s);
  WeakWindows windows(kWindow_s, kManyWindows);
  windows.add(stretch, stretch_terms(space, stretch), ShiftRange{0, 0});
  const auto count = static_cast<Eigen::Index>(of.columns.size());
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(count, count);
  for (const WeakWindow& w : windows.all())
    for (int j = 0; j < space.joints(); ++j) {
      const Eigen::RowVectorXd row = row_of(space, w, j)(of.columns) / of.joint_scale[j];
      moments += row.transpose() * row;
    }
  return moments / static_cast<double>(std::max<std::size_t>(windows.all().size(), 1));
}

double condition_of(const Eigen::MatrixXd& moments, const Eigen::VectorXd& unit) {
  const Eigen::VectorXd scale = unit.cwiseMax(std::numeric_limits<double>::min()).cwiseInverse();
  const Eigen::VectorXd values = symmetric_eigenvalues(scale.asDiagonal() * moments * scale.asDiagonal());
  const double least = values.minCoeff(), most = values.maxCoeff();
  return least > kRank * most ? std::sqrt(most / least) : std::numeric_limits<double>::infinity();
}

}  // namespace faultline
