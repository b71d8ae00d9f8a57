// SPDX-License-Identifier: MIT
#include "lib/identify/motion/sample_outliers.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr double kOutlier = 20.0;  ///< times the 90 % quantile of the distance from the neighbours' mean

/// Marks samples that are far from the mean of their neighbours while these agree with each other.
void switch_off_outliers(const Eigen::VectorXd& y, Eigen::VectorXi& off) {
  const int n = static_cast<int>(y.size());
  std::vector<double> bends;
  for (int k = 1; k + 1 < n; ++k) bends.push_back(std::abs(y[k] - 0.5 * (y[k - 1] + y[k + 1])));
  if (bends.empty()) return;
  const double usual = std::max(upper_quantile(bends, 0.9), 1e-9 * (1.0 + y.cwiseAbs().mean()));
  for (int k = 1; k + 1 < n; ++k)
    if (bends[k - 1] > kOutlier * usual && bends[k - 1] > 2.0 * std::abs(y[k + 1] - y[k - 1])) off[k] = 1;
}

}  // namespace

JointMotion joint_motion(const RawStretch& s, int joint) {
  JointMotion m;
  m.time = s.time;
  m.q = s.q.row(joint);
  m.q_off = s.stale;
  switch_off_outliers(m.q, m.q_off);
  if (s.dq.size() == 0) return m;
  m.dq = s.dq.row(joint);
  m.dq_off = s.stale;
  switch_off_outliers(m.dq, m.dq_off);
  return m;
}

}  // namespace faultline
