// SPDX-License-Identifier: MIT
#include "lib/balance/one_step/innovations.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using StateVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2 * kMaxJoints, 1>;

constexpr double kFirstPosition = 1.0;   // rad^2 or m^2: variance of the first state before its reading
constexpr double kFirstVelocity = 10.0;  // (rad/s)^2 or (m/s)^2
constexpr double kLeastProcess = 1e-13;  // variance of a state that rounding alone gives

/// Takes in one reading of state `i`.
void take_in(int i, double variance, const Eigen::RowVectorXd& reading, StateMatrix& covariance, MatrixXd& x,
             Innovations& out, int k) {
  const int states = out.states;
  if (variance > kNoReading) {
    out.variance(i, k) = std::numeric_limits<double>::quiet_NaN();
    out.white.row(k * states + i).setZero();
    out.gain.col(k * states + i).setZero();
    return;
  }
  const double s = covariance(i, i) + variance;
  const StateVector gain = covariance.col(i) / s;
  const Eigen::RowVectorXd off = reading - x.row(i);
  out.variance(i, k) = s;
  out.gain.col(k * states + i) = gain;
  out.white.row(k * states + i) = off / std::sqrt(s);
  x.noalias() += gain * off;
  covariance.noalias() -= s * gain * gain.transpose();
}

}  // namespace

Innovations innovations(const LinearSteps& steps, const FilterInput& in) {
  Innovations out;
  const int states = out.states = steps.states, columns = out.columns = in.columns(steps.intervals),
            wide = 1 + columns;
  const int samples = out.samples = steps.intervals + 1;
  out.white.resize(states * samples, wide);
  out.variance.resize(states, samples);
  out.gain.resize(states, states * samples);
  out.before.resize(states, wide * samples);
  out.after.resize(states, wide * samples);
  out.before_covariance.resize(states, states * samples);
  out.after_covariance.resize(states, states * samples);
  StateMatrix p = StateMatrix::Zero(states, states);
  p.diagonal().head(states / 2).setConstant(kFirstPosition);
  p.diagonal().tail(states / 2).setConstant(kFirstVelocity);
  MatrixXd x = MatrixXd::Zero(states, wide), moved(states, wide);
  Eigen::RowVectorXd reading = Eigen::RowVectorXd::Zero(wide);
  for (int k = 0; k < samples; ++k) {
    if (k > 0) {
      const auto a = steps.slope_of(k - 1);
      moved.noalias() = a * x;
      moved.col(0) += steps.miss.col(k - 1);
      moved.rightCols(columns) += in.column.middleCols((k - 1) * columns, columns);
      x.swap(moved);
      p = (a * p * a.transpose()).eval() + in.process.middleCols((k - 1) * states, states);
      p = (0.5 * (p + p.transpose())).eval();
    }
    out.before.middleCols(k * wide, wide) = x;
    out.before_covariance.middleCols(k * states, states) = p;
    for (int i = 0; i < states; ++i) {
      reading[0] = in.reading(i, k);
      if (in.read_column >= 0) reading[1 + in.read_column] = -in.read(i, k);
      take_in(i, in.variance(i, k), reading, p, x, out, k);
    }
    out.after.middleCols(k * wide, wide) = x;
    out.after_covariance.middleCols(k * states, states) = p;
  }
  out.white.rightCols(columns) *= -1.0;
  return out;
}

MatrixXd white_columns(const LinearSteps& steps, const Innovations& filter, const MatrixXd& column,
                       const MatrixXd& read, int columns, int first, int end) {
  const int states = filter.states;
  MatrixXd out = MatrixXd::Zero(states * (end - first), columns), x = MatrixXd::Zero(states, columns),
           moved(states, columns);
  Eigen::RowVectorXd off(columns);
  for (int k = first; k < end; ++k) {
    if (k > first) {
      moved.noalias() = steps.slope_of(k - 1) * x;
      x = moved + column.middleCols((k - 1) * columns, columns);
    }
    for (int i = 0; i < states; ++i) {
      const double s = filter.variance(i, k);
      if (std::isnan(s)) continue;
      off = read.block(i, k * columns, 1, columns) + x.row(i);
      out.row((k - first) * states + i) = off / std::sqrt(s);
      x.noalias() -= filter.gain.col(k * states + i) * off;
    }
  }
  return out;
}

Trajectory smoothed(const LinearSteps& steps, const Innovations& filter, const VectorXd& size,
                    MatrixXd* variance) {
  const int states = filter.states, samples = filter.samples, wide = 1 + filter.columns;
  VectorXd mix(wide);
  mix << 1.0, size;
  Trajectory out(states, samples);
  StateMatrix p = filter.after_covariance.rightCols(states);
  out.col(samples - 1) = filter.after.rightCols(wide) * mix;
  if (variance != nullptr) {
    variance->resize(states, samples);
    variance->col(samples - 1) = p.diagonal();
  }
  for (int k = samples - 2; k >= 0; --k) {
    const StateMatrix after = filter.after_covariance.middleCols(k * states, states);
    StateMatrix before = filter.before_covariance.middleCols((k + 1) * states, states);
    before.diagonal().array() += kLeastProcess;
    const StateMatrix gain = before.ldlt().solve((steps.slope_of(k) * after).eval()).transpose();
    const StateVector predicted = filter.before.middleCols((k + 1) * wide, wide) * mix;
    out.col(k) = filter.after.middleCols(k * wide, wide) * mix;
    out.col(k) += gain * (out.col(k + 1) - predicted);
    if (variance == nullptr) continue;
    before.diagonal().array() -= kLeastProcess;
    p = (after + gain * (p - before) * gain.transpose()).eval();
    variance->col(k) = p.diagonal();
  }
  return out;
}

MatrixXd process_covariance(const LinearSteps& steps, const MotionLayout& layout, const MatrixXd& force_std) {
  MatrixXd out(steps.states, steps.states * steps.intervals);
  for (int k = 0; k < steps.intervals; ++k) {
    const StateMatrix by_force =
        steps.number_of(k).middleCols(layout.force(0), layout.joints) * force_std.col(k).asDiagonal();
    auto block = out.middleCols(k * steps.states, steps.states);
    block.noalias() = by_force * by_force.transpose();
    block.diagonal().array() += kLeastProcess;
  }
  return out;
}

}  // namespace faultline
