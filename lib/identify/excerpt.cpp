// SPDX-License-Identifier: MIT
#include "lib/identify/excerpt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace faultline {
namespace {

Excerpt cut(const Stretch& s, int begin, int rows) {
  const int n = s.joints();
  Excerpt e;
  e.log = s.log;
  e.has_dq = s.has_dq;
  e.time = s.time.segment(begin, rows);
  e.tau = s.tau.middleCols(begin, rows);
  e.measured.resize(2 * n, rows);
  e.measured << s.q.middleCols(begin, rows), s.dq.middleCols(begin, rows);
  e.weight = (s.outlier.middleCols(begin, rows).array() == 0).cast<double>();
  if (!s.has_dq) e.weight.bottomRows(n).setZero();
  e.start.resize(2 * n);
  e.start << s.q_smooth.col(begin), s.dq_smooth.col(begin);
  const auto speed = s.dq_smooth.middleCols(begin, rows);
  e.travel = (speed.rowwise().maxCoeff() - speed.rowwise().minCoeff()).sum();
  return e;
}

}  // namespace

Excerpts::Excerpts(double segment_s, int min_rows, int max_rows)
    : segment_s_(segment_s), min_rows_(min_rows), max_rows_(max_rows) {}

void Excerpts::add(const Stretch& s) {
  const int rows = std::max(min_rows_, static_cast<int>(std::lround(segment_s_ / s.period_s)) + 1);
  for (int begin = 0; begin + rows <= s.rows(); begin += rows) {
    if (seen_++ % stride_ != 0) continue;
    pool_.push_back(cut(s, begin, rows));
    held_rows_ += rows;
    if (held_rows_ <= 2 * max_rows_) continue;
    std::vector<Excerpt> half;
    held_rows_ = 0;
    for (std::size_t i = 0; i < pool_.size(); i += 2) {
      held_rows_ += pool_[i].rows();
      half.push_back(std::move(pool_[i]));
    }
    pool_ = std::move(half);
    stride_ *= 2;
  }
}

std::vector<Excerpt> Excerpts::take() {
  std::vector<int> order(pool_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return pool_[a].travel > pool_[b].travel; });
  std::int64_t rows = 0;
  std::vector<int> chosen;
  for (int i : order) {
    if (!chosen.empty() && rows + pool_[i].rows() > max_rows_) break;
    rows += pool_[i].rows();
    chosen.push_back(i);
  }
  std::sort(chosen.begin(), chosen.end());
  std::vector<Excerpt> out;
  for (int i : chosen) out.push_back(std::move(pool_[i]));
  pool_.clear();
  return out;
}

void Roughness::add(const Stretch& s) {
  const int n = s.joints();
  if (sum_.size() == 0) {
    sum_ = count_ = Eigen::VectorXd::Zero(2 * n);
    low_ = Eigen::VectorXd::Constant(2 * n, std::numeric_limits<double>::infinity());
    high_ = -low_;
    first_ = s.q.col(0);
    samples_ = mean_ = square_ = steps_ = step_square_ = Eigen::VectorXd::Zero(n);
  }
  has_dq_ = has_dq_ || s.has_dq;
  add_steps(s);
  const bool smoothed = s.q_smooth != s.q;
  for (int c = 0; c < 2 * n; ++c) {
    const auto raw = c < n ? s.q.row(c) : s.dq.row(c - n);
    const auto smooth = c < n ? s.q_smooth.row(c) : s.dq_smooth.row(c - n);
    for (int k = 0; k < s.rows(); ++k) {
      if (s.outlier(c, k)) continue;
      low_[c] = std::min(low_[c], raw[k]);
      high_[c] = std::max(high_[c], raw[k]);
      if (!smoothed || (c >= n && !s.has_dq)) continue;
      sum_[c] += (raw[k] - smooth[k]) * (raw[k] - smooth[k]);
      count_[c] += 1.0;
    }
  }
}

void Roughness::add_steps(const Stretch& s) {
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

bool Roughness::still(int j, double least) const {
  if (high_[j] - low_[j] < least) return true;
  const double mean = mean_[j] / samples_[j], variance = square_[j] / samples_[j] - mean * mean;
  return steps_[j] > 0.0 && step_square_[j] / steps_[j] > variance;  // 2 for noise, near 0 for motion
}

Eigen::VectorXd Roughness::std() const {
  // A quadratic through 13 points leaves some 0.83 of white noise's variance; 0.8 stands for other lengths
  // too.
  constexpr double kLeft = 0.8;
  Eigen::VectorXd out = Eigen::VectorXd::Constant(sum_.size(), std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index c = 0; c < sum_.size(); ++c)
    if (count_[c] > 0.0) out[c] = std::sqrt(sum_[c] / count_[c] / kLeft);
  return out;
}

}  // namespace faultline
