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

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kShift = 1e-3;                                          // rad or m of a numeric derivative
constexpr std::array kDrifts{.003, .006, .012, .02, .03, .04, .06, .1};  // rad/s
constexpr double kSlideShare = 0.5;   // m/s of a slide for each rad/s of a revolute joint
constexpr double kNoTorque = 1e-9;    // N m for each rad: the position of such a joint does not matter
constexpr double kKernelReach = 4.0;  // standard deviations at which the kernel is cut

/// The impulse that a jump of a joint's velocity by 1 rad/s gives the momentum, for each onset: its product
/// with what is left over, and its own square.
struct Impulse {
  VectorXd product, square;
};

Impulse impulse_of(const WhiteSearch& s, const InertiaRows& all, int j) {
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
  const MatrixXd& inertia = all.column[j];
  for (int i = 0; i < fit.joints(); ++i) {
    if (inertia.col(i).isZero(0.0)) continue;
    const VectorXd y = s.weighted(i);
    for (int t = 0; t < rows; ++t) {
      const int a = std::max(0, t - half), b = std::min(rows, t + half + 1);
      vector[t] -= inertia(t, i) * y.segment(a, b - a).dot(kernel.segment(a - t + half, b - a));
      square[t] += s.weight[i * rows + t] * inertia(t, i) * inertia(t, i) * kernel.squaredNorm();
    }
  }
  return {std::move(vector), std::move(square)};
}

/// Changes of the torques by a position that is off: by 1 rad or m (`slope`), and by 1 rad or m more in each
/// second since the first row (`growing`). A drift that begins at time t is `growing` - t `slope`.
struct DriftingPosition {
  Stacked growing, slope;
};

DriftingPosition drifting_position(const LogFit& fit, int j) {
  JointReading moved = reading_of(fit.log(), j);
  moved.q.array() += kShift;
  DriftingPosition out;
  out.slope = (fit.residual_of(moved, j, fit.log().start_s) - fit.residual()) / kShift;
  const VectorXd time = fit.time_s().array() - fit.time_s()[0];
  out.growing = out.slope.cwiseProduct(time.replicate(fit.joints(), 1));
  return out;
}

/// Sums over each row and all later ones of two columns: friction with another velocity, and the position
/// that drifts.
class DriftSums {
 public:
  DriftSums(const WhiteSearch& s, int j)
      : s_(s),
        position_(drifting_position(s.fit, j)),
        time_(s.fit.time_s().array() - s.fit.time_s()[0]),
        growing_growing_(sums_from_each_row(s, position_.growing, position_.growing)),
        growing_slope_(sums_from_each_row(s, position_.growing, position_.slope)),
        slope_slope_(sums_from_each_row(s, position_.slope, position_.slope)),
        growing_left_(sums_from_each_row(s, position_.growing, s.left)),
        slope_left_(sums_from_each_row(s, position_.slope, s.left)),
        growing_effects_(effect_sums_from_each_row(s, position_.growing)),
        slope_effects_(effect_sums_from_each_row(s, position_.slope)) {}

  /// Nats, by onset, for a drift of `d` rad/s (m/s) with the torque `friction` that it adds.
  VectorXd gain(const Stacked& friction, double d) const {
    ArrayXd with_left = sums_from_each_row(s_, friction, s_.left).array();
    ArrayXd square = sums_from_each_row(s_, friction, friction).array();
    MatrixXd effects = effect_sums_from_each_row(s_, friction);
    if (!position_.slope.isZero(kNoTorque)) {
      with_left += d * (growing_left_ - time_ * slope_left_);
      square += 2.0 * d *
                    (sums_from_each_row(s_, friction, position_.growing).array() -
                     time_ * sums_from_each_row(s_, friction, position_.slope).array()) +
                d * d * (growing_growing_ - time_ * (2.0 * growing_slope_ - time_ * slope_slope_));
      effects += d * (growing_effects_ - slope_effects_ * time_.matrix().asDiagonal());
    }
    return with_left - 0.5 * (square - effects.array().square().colwise().sum().transpose());
  }

 private:
  const WhiteSearch& s_;
  DriftingPosition position_;
  ArrayXd time_;
  ArrayXd growing_growing_, growing_slope_, slope_slope_, growing_left_, slope_left_;
  MatrixXd growing_effects_, slope_effects_;
};

}  // namespace

InertiaRows inertia_rows(const LogFit& fit) {
  const BalanceModel& m = fit.model();
  const Chain<double> chain = chain_of(m.rigid, m.theta);
  InertiaRows out;
  out.column.assign(fit.joints(), MatrixXd(fit.count(), fit.joints()));
  for (int t = 0; t < fit.count(); ++t) {
    const JointVector<double> q = fit.rows().q.row(t).transpose();
    const JointMatrix<double> inertia = inertia_matrix(chain, q);
    for (int j = 0; j < fit.joints(); ++j) out.column[j].row(t) = inertia.col(j).transpose();
  }
  return out;
}

std::vector<Candidate> search_drift(const WhiteSearch& s, const InertiaRows& inertia, int j) {
  std::vector<Candidate> out;
  const LogFit& fit = s.fit;
  const BalanceModel& m = fit.model();
  const ColumnLayout layout = m.layout();
  const int rows = fit.count();
  const double scale = m.rigid.chain.geometry[j].kind == AxisKind::revolute ? 1.0 : kSlideShare;
  const DriftSums sums(s, j);
  const Impulse impulse = impulse_of(s, inertia, j);
  const auto friction = [&](double v) {
    return m.theta[layout.viscous(j)] * v +
           m.theta[layout.coulomb(j)] * elementary::tanh(v / m.setting.friction_width[j]);
  };
  const VectorXd as_read = fit.rows().dq.col(j).unaryExpr(friction);
  for (const double size : kDrifts)
    for (const double sign : {-1.0, 1.0}) {
      const double d = scale * sign * size;
      Stacked changed = Stacked::Zero(rows * fit.joints());
      changed.segment(j * rows, rows) =
          fit.rows().dq.col(j).unaryExpr([&](double v) { return friction(v - d); }) - as_read;
      const VectorXd gain = sums.gain(changed, d) + d * impulse.product - 0.5 * d * d * impulse.square;
      const std::vector<Candidate> best = peaks(fit, {FaultKind::sensor_drift, j + 1, 0.0, 0.0, d}, gain, 1);
      out.insert(out.end(), best.begin(), best.end());
    }
  return out;
}

}  // namespace faultline
