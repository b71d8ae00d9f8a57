// SPDX-License-Identifier: MIT
#include "lib/explain/search/drift_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lib/core/elementary/elementary.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kShift = 1e-3;                                          // rad or m of a numeric derivative
constexpr std::array kDrifts{.003, .006, .012, .02, .03, .04, .06, .1};  // rad/s
constexpr double kSlideShare = 0.5;  // m/s of a slide for each rad/s of a revolute joint
constexpr double kNoTorque = 1e-9;   // N m for each rad: the position of such a joint does not matter
constexpr double kKernelReach = 4.0;

/// Column `j` of the inertia matrix in each row: rows x joints.
MatrixXd inertia_columns(const LogFit& fit, int j) {
  const BalanceModel& m = fit.model();
  const Chain<double> chain = chain_of(m.rigid, m.theta);
  MatrixXd out(fit.count(), fit.joints());
  for (int t = 0; t < fit.count(); ++t) {
    const JointVector<double> q = fit.rows().q.row(t).transpose();
    out.row(t) = inertia_matrix(chain, q).col(j).transpose();
  }
  return out;
}

/// The impulse that a jump of a joint's velocity by 1 rad/s gives the momentum, for each onset: its product
/// with what is left over, and its own square.
struct Impulse {
  VectorXd product, square;
};

Impulse impulse_of(const WhiteSearch& s, int j) {
  const LogFit& fit = s.fit;
  const RowSetting& setting = fit.model().setting;
  const int rows = fit.count(),
            half = static_cast<int>(std::ceil(kKernelReach * setting.kernel_s / setting.row_s()));
  VectorXd kernel(2 * half + 1);
  for (int k = -half; k <= half; ++k) {
    const double x = k * setting.row_s() / setting.kernel_s;
    kernel[half + k] = elementary::exp(-0.5 * x * x) / (setting.kernel_s * std::sqrt(2.0 * std::numbers::pi));
  }
  VectorXd vector = VectorXd::Zero(rows), square = VectorXd::Zero(rows);
  const MatrixXd inertia = inertia_columns(fit, j);
  for (int i = 0; i < fit.joints(); ++i) {
    if (inertia.col(i).isZero(0.0)) continue;
    const VectorXd y = s.weighted(i);
    for (int t = 0; t < rows; ++t) {
      const int a = std::max(0, t - half), b = std::min(rows, t + half + 1);
      vector[t] -= inertia(t, i) * y.segment(a, b - a).dot(kernel.segment(a - t + half, b - a));
      const double std = fit.std()(t, i);
      square[t] += s.precision[i] / (std * std) * inertia(t, i) * inertia(t, i) * kernel.squaredNorm();
    }
  }
  return {std::move(vector), std::move(square)};
}

}  // namespace

std::vector<Candidate> search_drift(const WhiteSearch& s, int j) {
  std::vector<Candidate> out;
  const LogFit& fit = s.fit;
  const BalanceModel& m = fit.model();
  const ColumnLayout layout = m.layout();
  const int rows = fit.count();
  const double scale = m.rigid.chain.geometry[j].kind == AxisKind::revolute ? 1.0 : kSlideShare;
  JointReading moved = reading_of(fit.log(), j);
  moved.q.array() += kShift;
  const Stacked slope = (fit.residual_of(moved, j, fit.log().start_s) - fit.residual()) / kShift;
  const bool matters = slope.cwiseAbs().maxCoeff() > kNoTorque;
  const VectorXd time = fit.time_s().array() - fit.time_s()[0];
  const Impulse impulse = impulse_of(s, j);
  const auto friction = [&](double v) {
    return m.theta[layout.viscous(j)] * v +
           m.theta[layout.coulomb(j)] * elementary::tanh(v / m.setting.friction_width[j]);
  };
  for (const double size : kDrifts)
    for (const double sign : {-1.0, 1.0}) {
      const double d = scale * sign * size;
      StackedColumns columns = StackedColumns::Zero(rows * fit.joints(), matters ? 3 : 1);
      for (int k = 0; k < rows; ++k) {
        const double v = fit.rows().dq(k, j);
        columns(j * rows + k, 0) = friction(v - d) - friction(v);
      }
      MatrixXd fixed = MatrixXd::Ones(rows, columns.cols());
      if (matters) {
        for (int i = 0; i < fit.joints(); ++i)
          columns.col(1).segment(i * rows, rows) = slope.segment(i * rows, rows).cwiseProduct(time);
        columns.col(2) = slope;
        fixed.col(1).setConstant(d);
        fixed.col(2) = -d * time;
      }
      const VectorXd gain =
          onset_gains_of_size(s, columns, fixed) + d * impulse.product - 0.5 * d * d * impulse.square;
      const std::vector<Candidate> best = peaks(fit, {FaultKind::sensor_drift, j + 1, 0.0, 0.0, d}, gain, 1);
      out.insert(out.end(), best.begin(), best.end());
    }
  return out;
}

}  // namespace faultline
