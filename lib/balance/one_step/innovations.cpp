// SPDX-License-Identifier: MIT
#include "lib/balance/one_step/innovations.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "lib/balance/one_step/linear_steps.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFirstPosition = 1.0;   // rad^2 or m^2: variance of the first position before it is measured
constexpr double kFirstVelocity = 10.0;  // (rad/s)^2 or (m/s)^2: the same of the first velocity
constexpr double kLeastProcess = 1e-13;  // variance added to each state: that of rounding

template <int kStates>
using Square = SmallMatrix<kStates, kStates>;
template <int kStates>
using State = SmallMatrix<kStates, 1>;
template <int kStates>
using Wide = Eigen::Matrix<double, kStates, Eigen::Dynamic>;

/// States of the data and of each column, with their common covariance.
template <int kStates>
struct Filter {
  Square<kStates> covariance;
  Wide<kStates> state;
};

/// Updates the filter with the measurement of state `i` at sample `k`.
template <int kStates>
void take_in(int i, double variance, const Eigen::RowVectorXd& reading, Filter<kStates>& filter,
             Innovations& out, int k) {
  const int states = out.states;
  if (variance > kNoReading) {
    out.variance(i, k) = std::numeric_limits<double>::quiet_NaN();
    out.white.row(k * states + i).setZero();
    out.gain.col(k * states + i).setZero();
    return;
  }
  const double s = filter.covariance(i, i) + variance;
  const State<kStates> gain = filter.covariance.col(i) / s;
  const Eigen::RowVectorXd off = reading - filter.state.row(i);
  out.variance(i, k) = s;
  out.gain.col(k * states + i) = gain;
  out.white.row(k * states + i) = off / std::sqrt(s);
  for (Eigen::Index c = 0; c < off.size(); ++c) filter.state.col(c) += off[c] * gain;
  filter.covariance -= s * gain * gain.transpose();
}

template <int kStates>
void filter_all(const LinearSteps& steps, const FilterInput& in, Innovations& out) {
  const int states = out.states, columns = out.columns, wide = 1 + columns;
  Filter<kStates> filter{Square<kStates>::Zero(states, states), Wide<kStates>::Zero(states, wide)};
  filter.covariance.diagonal().head(states / 2).setConstant(kFirstPosition);
  filter.covariance.diagonal().tail(states / 2).setConstant(kFirstVelocity);
  Eigen::RowVectorXd reading = Eigen::RowVectorXd::Zero(wide);
  for (int k = 0; k < out.samples; ++k) {
    if (k > 0) {
      const Square<kStates> a = steps.slope_of(k - 1);
      for (int c = 0; c < wide; ++c) filter.state.col(c) = (a * filter.state.col(c)).eval();
      filter.state.col(0) += steps.miss.col(k - 1);
      filter.state.rightCols(columns) += in.column.middleCols((k - 1) * columns, columns);
      const Square<kStates> p =
          a * filter.covariance * a.transpose() + in.process.middleCols((k - 1) * states, states);
      filter.covariance = 0.5 * (p + p.transpose());
    }
    out.before.middleCols(k * wide, wide) = filter.state;
    out.before_covariance.middleCols(k * states, states) = filter.covariance;
    for (int i = 0; i < states; ++i) {
      reading[0] = in.reading(i, k);
      if (in.read_column >= 0) reading[1 + in.read_column] = -in.read(i, k);
      take_in(i, in.variance(i, k), reading, filter, out, k);
    }
    out.after.middleCols(k * wide, wide) = filter.state;
    out.after_covariance.middleCols(k * states, states) = filter.covariance;
  }
}

template <int kStates>
Trajectory smooth_all(const LinearSteps& steps, const Innovations& filter, const VectorXd& mix,
                      MatrixXd* variance) {
  const int states = filter.states, samples = filter.samples, wide = 1 + filter.columns;
  Trajectory out(states, samples);
  Square<kStates> p = filter.after_covariance.rightCols(states);
  out.col(samples - 1) = filter.after.rightCols(wide) * mix;
  if (variance != nullptr) variance->col(samples - 1) = p.diagonal();
  for (int k = samples - 2; k >= 0; --k) {
    const Square<kStates> after = filter.after_covariance.middleCols(k * states, states),
                          slope = steps.slope_of(k);
    Square<kStates> before = filter.before_covariance.middleCols((k + 1) * states, states);
    before.diagonal().array() += kLeastProcess;
    const Square<kStates> gain = before.ldlt().solve((slope * after).eval()).transpose();
    const State<kStates> predicted = filter.before.middleCols((k + 1) * wide, wide) * mix,
                         filtered = filter.after.middleCols(k * wide, wide) * mix, next = out.col(k + 1);
    out.col(k) = filtered + gain * (next - predicted);
    if (variance == nullptr) continue;
    before.diagonal().array() -= kLeastProcess;
    p = (after + gain * (p - before) * gain.transpose()).eval();
    variance->col(k) = p.diagonal();
  }
  return out;
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
  with_state_count(states, [&](auto count) { filter_all<count>(steps, in, out); });
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
  VectorXd mix(1 + filter.columns);
  mix << 1.0, size;
  if (variance != nullptr) variance->resize(filter.states, filter.samples);
  return with_state_count(filter.states,
                          [&](auto count) { return smooth_all<count>(steps, filter, mix, variance); });
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
