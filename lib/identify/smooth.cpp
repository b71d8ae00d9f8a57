// SPDX-License-Identifier: MIT
#include "lib/identify/smooth.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

constexpr double kSmoothSpan_s = 0.012;

/// Half the number of neighbours that a local quadratic uses; 0 on logs too slow for it.
int half_span(double period_s) {
  const int half = static_cast<int>(std::lround(0.5 * kSmoothSpan_s / period_s));
  return half >= 2 ? std::min(half, 50) : 0;
}

struct LocalFit {
  double value = 0.0;
  double slope = 0.0;
};

/// Least-squares quadratic through the points around `k` (cut at the ends), at `k`.
LocalFit local_quadratic(const Eigen::VectorXd& t, const Eigen::Ref<const Eigen::RowVectorXd>& y, int k,
                         int half) {
  const int n = static_cast<int>(t.size());
  const int begin = std::max(0, k - half), end = std::min(n, k + half + 1);
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  const double scale = t[end - 1] - t[begin];
  for (int i = begin; i < end; ++i) {
    const double x = (t[i] - t[k]) / scale;
    const Eigen::Vector3d row(1.0, x, x * x);
    a += row * row.transpose();
    b += row * (y[i] - y[k]);
  }
  const Eigen::Vector3d c = a.ldlt().solve(b);
  return {y[k] + c[0], c[1] / scale};
}

}  // namespace

void smooth(Stretch& s) {
  const int half = half_span(s.period_s);
  s.q_smooth = s.q;
  s.dq_smooth = s.dq;
  for (int j = 0; j < s.joints(); ++j)
    for (int k = 0; k < s.rows(); ++k) {
      if (half == 0 && s.has_dq) continue;
      const LocalFit position = local_quadratic(s.time, s.q.row(j), k, std::max(half, 1));
      if (!s.has_dq) s.dq(j, k) = s.dq_smooth(j, k) = position.slope;
      if (half == 0) continue;
      s.q_smooth(j, k) = position.value;
      if (s.has_dq) s.dq_smooth(j, k) = local_quadratic(s.time, s.dq.row(j), k, half).value;
    }
}

}  // namespace faultline
