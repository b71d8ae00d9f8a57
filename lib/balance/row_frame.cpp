// SPDX-License-Identifier: MIT
#include "lib/balance/row_frame.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "lib/balance/rows.hpp"
#include "lib/balance/smoothing.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd middle(const MatrixXd& values) {
  const Index n = values.rows() - 1;
  return 0.5 * (values.topRows(n) + values.bottomRows(n));
}

/// Writes the torque that acts in each interval, and its step over the interval, to `out`.
void read_torque(const MatrixXd& tau, const RowSetting& setting, Intervals& out) {
  const Index n = tau.rows() - 1;
  const bool is_held = setting.torque_is_held && setting.averaged == 1;  // means are interpolated linearly
  out.torque.resize(n, tau.cols());
  out.torque_step.resize(n, tau.cols());
  for (Index k = 0; k < n; ++k) {
    const Index a = std::clamp<Index>(k + setting.torque_lag, 0, n);
    const Index b = std::clamp<Index>(k + 1 + setting.torque_lag, 0, n);
    out.torque.row(k) = is_held ? tau.row(a).eval() : (0.5 * (tau.row(a) + tau.row(b))).eval();
    out.torque_step.row(k) = tau.row(b) - tau.row(a);
  }
}

Intervals intervals(const UniformLog& log, const RowSetting& setting) {
  Intervals out;
  read_torque(log.tau, setting, out);
  out.velocity = fused_velocity(log, setting);
  out.q = middle(log.q);
  out.link_speed.resize(out.q.rows(), out.q.cols());
  for (int j = 0; j < setting.joints(); ++j)
    out.link_speed.col(j) = link_speed(out.velocity.col(j), out.torque.col(j), setting, j);
  return out;
}

int reach_samples(const RowSetting& setting, const VectorXd& kernel) {
  const Index friction = gaussian_kernel(setting.friction_s, setting.period_s).size();
  return static_cast<int>(kernel.size() / 2 + friction / 2 + 1);
}

CoarseGrid coarse_grid(int samples, const RowSetting& setting, const VectorXd& kernel) {
  CoarseGrid grid;
  grid.first = reach_samples(setting, kernel);
  grid.step = setting.decimation;
  const int last = samples - 1 - grid.first;  // one beyond the last middle
  grid.count = last > grid.first ? (last - grid.first + grid.step - 1) / grid.step : 0;
  return grid;
}

[[noreturn]] void too_short(const UniformLog& log, const RowSetting& setting) {
  throw Error(ErrorCode::input, "",
              "the log lasts " + std::to_string(log.rows() * setting.period_s) +
                  " s, which is shorter than the kernel that smooths it; record longer logs");
}

}  // namespace

RowFrame row_frame(const UniformLog& log, const RowSetting& setting) {
  const VectorXd kernel = gaussian_kernel(setting.kernel_s, setting.period_s);
  const CoarseGrid grid = coarse_grid(log.rows(), setting, kernel);
  if (grid.count < 2) too_short(log, setting);
  return {kernel, grid, intervals(log, setting)};
}

VectorXd link_speed(const VectorXd& velocity, const VectorXd& torque, const RowSetting& setting, int j) {
  const VectorXd kernel = gaussian_kernel(setting.friction_s, setting.period_s);
  VectorXd out = middle(smooth(velocity, kernel));
  if (setting.compliance.size() > 0 && setting.compliance[j] > 0.0)
    out -= setting.compliance[j] * gradient(smooth(torque, kernel), setting.period_s);
  return out;
}

Eigen::MatrixX3d drive_columns(const CoupledDrive& drive, const MatrixXd& velocity, const MatrixXd& speed,
                               double period_s) {
  const VectorXd turning = velocity * drive.along, own = speed * drive.along;
  const Index n = own.size();
  Eigen::MatrixX3d out(n, 3);
  out << (turning.tail(n) - turning.head(n)) / period_s, own, saturated(own, drive.friction_width);
  return out;
}

VectorXd saturated(const VectorXd& speed, double width) {
  return speed.unaryExpr([width](double v) { return elementary::tanh(v / width); });
}

double reach_s(const RowSetting& setting) {
  return setting.period_s * reach_samples(setting, gaussian_kernel(setting.kernel_s, setting.period_s));
}

double velocity_reach_s(const RowSetting& setting, double share) {
  if (setting.fusion.size() == 0) return 0.0;
  const double decay = setting.fusion.maxCoeff();
  if (decay >= 1.0) return std::numeric_limits<double>::infinity();
  return decay > 0.0 ? setting.period_s * elementary::log(share) / elementary::log(decay) : 0.0;
}

VectorXd fused_velocity(const MeasuredMotion& reading, const RowSetting& setting, int j) {
  const VectorXd difference = gradient(reading.q, setting.period_s);
  if (!setting.measures_velocity(j) || reading.dq.size() == 0) return difference;
  VectorXd off = difference - reading.dq;
  const Index last = off.size() - 1;
  if (last > 1) off[0] = off[1], off[last] = off[last - 1];  // at the ends a difference is half a sample off
  return reading.dq + two_sided_exponential(off, setting.fusion[j]);
}

MatrixXd fused_velocity(const UniformLog& log, const RowSetting& setting) {
  MatrixXd out(log.q.rows(), log.q.cols());
  for (int j = 0; j < log.joints(); ++j) out.col(j) = fused_velocity(reading_of(log, j), setting, j);
  return out;
}

}  // namespace faultline
