// SPDX-License-Identifier: MIT
#include "lib/identify/motion/motion_smoother.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kSettlingRows = 20;         // at the start, excluded from the likelihood: its first guess
constexpr double kFirstBandwidth = 0.05;  // of the sample rate: start of the search
constexpr double kFirstStep = 2.0;        // in the logarithm of a noise level
constexpr double kLastStep = 0.25;        // ends the search: an eighth of the noise is accurate enough
constexpr double kGain = 1e-3;            // of the log likelihood: a smaller increase is no progress
constexpr int kSmootherMostRounds = 40;   // of the search, which otherwise ends with kLastStep
constexpr double kRelativeFloor = 1e-9;   // of range and largest value: rounding of a double that was printed

Matrix3d transition(double h) {
  Matrix3d f = Matrix3d::Identity();
  f(0, 1) = f(1, 2) = h;
  f(0, 2) = 0.5 * h * h;
  return f;
}

/// Returns the covariance that white jerk of density 1 adds over h seconds.
Matrix3d jerk_covariance(double h) {
  const double h2 = h * h, h3 = h2 * h;
  Matrix3d q;
  q << h3 * h2 / 20.0, h2 * h2 / 8.0, h3 / 6.0, h2 * h2 / 8.0, h3 / 3.0, h2 / 2.0, h3 / 6.0, h2 / 2.0, h;
  return q;
}

struct FilterState {
  Vector3d mean = Vector3d::Zero();
  Matrix3d covariance = Matrix3d::Zero();
};

FilterState initial_state(const JointMotion& m, const MotionNoise& noise) {
  FilterState b;
  const int last = std::min(m.rows() - 1, 4);
  const double span = m.time[last] - m.time[0];
  b.mean[0] = m.q[0];
  b.mean[1] = m.dq.size() > 0 ? m.dq[0] : (m.q[last] - m.q[0]) / span;
  const double speed = std::abs(b.mean[1]) + noise.q_std / span + noise.dq_std, change = 10.0 * speed / span;
  b.covariance.diagonal() << 100.0 * noise.q_std * noise.q_std, speed * speed, change * change;
  return b;
}

/// Updates the state by one measurement of component i; returns its log likelihood without constants.
double update(FilterState& b, int i, double measured, double std) {
  const double variance = b.covariance(i, i) + std * std, error = measured - b.mean[i];
  const Vector3d gain = b.covariance.col(i) / variance;
  b.mean += gain * error;
  b.covariance -= gain * b.covariance.row(i).eval();
  return -0.5 * (elementary::log(variance) + error * error / variance);
}

double take_row(FilterState& b, const JointMotion& m, const MotionNoise& noise, int k) {
  double likelihood = 0.0;
  if (!m.q_off[k]) likelihood += update(b, 0, m.q[k], noise.q_std);
  if (m.dq.size() > 0 && !m.dq_off[k]) likelihood += update(b, 1, m.dq[k], noise.dq_std);
  return likelihood;
}

void predict(FilterState& b, double h, double jerk_density) {
  const Matrix3d f = transition(h);
  b.mean = f * b.mean;
  b.covariance = f * b.covariance * f.transpose() + jerk_density * jerk_covariance(h);
}

double log_likelihood(const JointMotion& m, const MotionNoise& noise) {
  FilterState b = initial_state(m, noise);
  double sum = 0.0;
  for (int k = 0; k < m.rows(); ++k) {
    if (k > 0) predict(b, m.time[k] - m.time[k - 1], noise.jerk_density);
    const double one = take_row(b, m, noise, k);
    if (k >= kSettlingRows) sum += one;
  }
  return std::isfinite(sum) ? sum : -std::numeric_limits<double>::infinity();
}

/// Returns the smallest step between different values, as a standard deviation; at least rounding.
double least_std(const Eigen::VectorXd& y) {
  double step = std::numeric_limits<double>::infinity();
  const double range = y.maxCoeff() - y.minCoeff(),
               rounding = kRelativeFloor * (range + y.cwiseAbs().maxCoeff());
  for (Eigen::Index k = 1; k < y.size(); ++k) {
    const double d = std::abs(y[k] - y[k - 1]);
    if (d > rounding) step = std::min(step, d);
  }
  const double quantised = std::isfinite(step) ? step / std::sqrt(12.0) : 0.0;
  return std::max({std::min(quantised, 0.01 * range), rounding, 1e-12});
}

/// Returns the std of white noise from third differences, whose variance is 20 times as large.
double rough_std(const Eigen::VectorXd& y) {
  std::vector<double> size;
  for (Eigen::Index k = 3; k < y.size(); ++k)
    size.push_back(std::abs(y[k] - 3.0 * y[k - 1] + 3.0 * y[k - 2] - y[k - 3]));
  return size.empty() ? 0.0 : 1.4826 * upper_median_of(size) / std::sqrt(20.0);
}

/// Converts to units of the sample period, in which all quantities of the filter are of similar size.
struct InPeriods {
  double period;

  explicit InPeriods(const JointMotion& m) : period((m.time[m.rows() - 1] - m.time[0]) / (m.rows() - 1)) {}
  JointMotion operator()(const JointMotion& m) const {
    JointMotion out = m;
    out.time /= period;
    out.dq *= period;
    return out;
  }
  MotionNoise operator()(const MotionNoise& n) const {
    return {n.q_std, n.dq_std * period, n.jerk_density * elementary::pow(period, 5.0)};
  }
  MotionNoise back(const MotionNoise& n) const {
    return {n.q_std, n.dq_std / period, n.jerk_density / elementary::pow(period, 5.0)};
  }
};

/// Returns the noise of these logarithmic levels: q, jerk, dq.
MotionNoise noise_at(const std::array<double, 3>& level, bool has_dq) {
  return {elementary::exp(level[0]), has_dq ? elementary::exp(level[2]) : 0.0, elementary::exp(level[1])};
}

}  // namespace

SmoothMotion smooth_motion(const JointMotion& measured, const MotionNoise& level) {
  const InPeriods in_periods(measured);
  const JointMotion m = in_periods(measured);
  const MotionNoise noise = in_periods(level);
  const int n = m.rows();
  std::vector<FilterState> filtered(n), predicted(n);
  FilterState b = initial_state(m, noise);
  for (int k = 0; k < n; ++k) {
    if (k > 0) predict(b, m.time[k] - m.time[k - 1], noise.jerk_density);
    predicted[k] = b;
    take_row(b, m, noise, k);
    filtered[k] = b;
  }
  SmoothMotion out{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  Vector3d next = filtered[n - 1].mean;
  out.q[n - 1] = next[0];
  out.dq[n - 1] = next[1];
  for (int k = n - 2; k >= 0; --k) {
    const Matrix3d f = transition(m.time[k + 1] - m.time[k]);
    const Matrix3d gain = filtered[k].covariance * f.transpose() * predicted[k + 1].covariance.inverse();
    next = (filtered[k].mean + gain * (next - predicted[k + 1].mean)).eval();
    out.q[k] = next[0];
    out.dq[k] = next[1];
  }
  out.dq /= in_periods.period;
  return out;
}

MotionNoise fit_motion_noise(const JointMotion& measured) {
  const InPeriods in_periods(measured);
  const JointMotion m = in_periods(measured);
  const bool has_dq = m.dq.size() > 0;
  const double q_floor = elementary::log(least_std(m.q)),
               dq_floor = has_dq ? elementary::log(least_std(m.dq)) : 0.0;
  std::array<double, 3> level{};
  level[0] = std::max(q_floor, elementary::log(std::max(rough_std(m.q), 1e-300)));
  level[1] = 2.0 * level[0] + 6.0 * elementary::log(2.0 * std::numbers::pi * kFirstBandwidth);
  if (has_dq) level[2] = std::max(dq_floor, elementary::log(std::max(rough_std(m.dq), 1e-300)));
  double best = log_likelihood(m, noise_at(level, has_dq));
  double step = kFirstStep;
  for (int round = 0; round < kSmootherMostRounds && step >= kLastStep; ++round) {
    bool moved = false;
    for (int i = 0; i < (has_dq ? 3 : 2); ++i)
      for (const double by : {step, -step}) {
        std::array<double, 3> tried = level;
        tried[i] += by;
        tried[0] = std::max(tried[0], q_floor);
        if (has_dq) tried[2] = std::max(tried[2], dq_floor);
        if (tried == level) continue;
        const double reached = log_likelihood(m, noise_at(tried, has_dq));
        if (!(reached > best + kGain)) continue;
        best = reached;
        level = tried;
        moved = true;
        break;
      }
    if (!moved) step *= 0.5;
  }
  return in_periods.back(noise_at(level, has_dq));
}

}  // namespace faultline
