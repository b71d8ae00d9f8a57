// SPDX-License-Identifier: MIT
#include "lib/identify/motion/measurements.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faultline {
namespace {

constexpr double kStill = 20.0;          // times the noise of q: a joint of smaller range does not move
constexpr double kLeastMotion = 1e-4;    // rad or m
constexpr double kLeastShare = 1e-7;     // of the range: rounding
constexpr double kLeastNoise = 1e-9;     // rad, m, rad/s or m/s
constexpr double kUnknownShare = 0.005;  // of the range: noise, if no log has an estimate

}  // namespace

void Measurements::add(const Stretch& s) {
  const int n = s.joints();
  if (count_.size() == 0) {
    square_sum_ = count_ = Eigen::VectorXd::Zero(2 * n);
    low_ = Eigen::VectorXd::Constant(2 * n, std::numeric_limits<double>::infinity());
    high_ = -low_;
    first_ = s.q.col(0);
    samples_ = mean_ = square_ = steps_ = step_square_ = Eigen::VectorXd::Zero(n);
  }
  has_dq_ = has_dq_ || s.has_dq;
  add_steps(s);
  for (int c = 0; c < 2 * n; ++c) {
    const auto raw = c < n ? s.q.row(c) : s.dq.row(c - n);
    for (int k = 0; k < s.rows(); ++k) {
      if (c < n && s.outlier(c, k)) continue;
      low_[c] = std::min(low_[c], raw[k]);
      high_[c] = std::max(high_[c], raw[k]);
    }
    if (s.noise[c] <= 0.0) continue;
    square_sum_[c] += s.rows() * s.noise[c] * s.noise[c];
    count_[c] += s.rows();
  }
}

void Measurements::add_steps(const Stretch& s) {
  for (int j = 0; j < s.joints(); ++j)
    for (int k = 0; k < s.rows(); ++k) {
      if (s.outlier(j, k)) continue;
      const double x = s.q(j, k) - first_[j];
      samples_[j] += 1.0;
      mean_[j] += x;
      square_[j] += x * x;
      if (k == 0 || s.outlier(j, k - 1)) continue;
      steps_[j] += 1.0;
      step_square_[j] += (s.q(j, k) - s.q(j, k - 1)) * (s.q(j, k) - s.q(j, k - 1));
    }
}

Eigen::VectorXd Measurements::std() const {
  Eigen::VectorXd out = kUnknownShare * (high_ - low_);
  for (Eigen::Index c = 0; c < out.size(); ++c)
    if (count_[c] > 0.0) out[c] = std::sqrt(square_sum_[c] / count_[c]);
  return out;
}

Eigen::VectorXd Measurements::floor() const { return (kLeastShare * (high_ - low_)).cwiseMax(kLeastNoise); }

bool Measurements::still(int j) const {
  const double jitter = count_[j] > 0.0 ? kStill * std()[j] : 0.0;
  if (high_[j] - low_[j] < std::max(jitter, kLeastMotion)) return true;
  const double mean = mean_[j] / samples_[j], variance = square_[j] / samples_[j] - mean * mean;
  return steps_[j] > 0.0 && step_square_[j] / steps_[j] > variance;  // 2 for noise, near 0 for motion
}

}  // namespace faultline
