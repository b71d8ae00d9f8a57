// SPDX-License-Identifier: MIT
#include "lib/balance/smoothing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

constexpr double kReach = 4.0;  // standard deviations at which a kernel is cut

/// Normal distribution function at equal distances, with cubic polynomials between them.
class NormalTable {
 public:
  NormalTable() {
    for (int k = 0; k < kNodes; ++k) {
      const double x = k / kPerUnit - kEnd;
      value_[k] = 0.5 * elementary::erfc(-x / std::numbers::sqrt2);
      slope_[k] = normal_density(x, 1.0) / kPerUnit;
    }
  }

  double at(double x) const {
    if (std::isnan(x)) return x;
    if (std::abs(x) >= kEnd) return x > 0.0 ? 1.0 : 0.0;
    const double place = (x + kEnd) * kPerUnit;
    const int k = std::min(static_cast<int>(place), kNodes - 2);  // just below the end, `place` rounds to it
    const double s = place - k, r = 1.0 - s;
    return r * r * ((1.0 + 2.0 * s) * value_[k] + s * slope_[k]) +
           s * s * ((1.0 + 2.0 * r) * value_[k + 1] - r * slope_[k + 1]);
  }

 private:
  static constexpr double kEnd = 6.0;       // standard deviations: beyond, the function is 0 or 1 within 1e-9
  static constexpr double kPerUnit = 32.0;  // nodes for each standard deviation: cubics err by 2e-9
  static constexpr int kNodes = static_cast<int>(2.0 * kEnd * kPerUnit) + 1;
  std::array<double, kNodes> value_{}, slope_{};
};

}  // namespace

Eigen::VectorXd gaussian_kernel(double sigma_s, double period_s) {
  if (sigma_s <= 0.0) return Eigen::VectorXd::Ones(1);
  const int half = static_cast<int>(std::ceil(kReach * sigma_s / period_s));
  Eigen::VectorXd weight(2 * half + 1);
  for (int k = -half; k <= half; ++k) {
    const double x = k * period_s / sigma_s;
    weight[half + k] = elementary::exp(-0.5 * x * x);
  }
  return weight / weight.sum();
}

Eigen::MatrixXd smooth(const Eigen::MatrixXd& values, const Eigen::VectorXd& kernel) {
  if (kernel.size() == 1) return values;
  const int half = static_cast<int>(kernel.size()) / 2, rows = static_cast<int>(values.rows());
  Eigen::MatrixXd padded(rows + 2 * half, values.cols());
  padded.middleRows(half, rows) = values;
  padded.topRows(half).rowwise() = values.row(0);
  padded.bottomRows(half).rowwise() = values.row(rows - 1);
  return smooth_at(padded, kernel, half, 1, rows);
}

Eigen::MatrixXd smooth_at(const Eigen::MatrixXd& values, const Eigen::VectorXd& kernel, int first, int step,
                          int count) {
  const int half = static_cast<int>(kernel.size()) / 2;
  Eigen::MatrixXd out(count, values.cols());
  for (int c = 0; c < values.cols(); ++c)
    for (int m = 0; m < count; ++m)
      out(m, c) = kernel.dot(values.col(c).segment(first + m * step - half, kernel.size()));
  return out;
}

Eigen::VectorXd gradient(const Eigen::VectorXd& values, double period_s) {
  const int rows = static_cast<int>(values.size());
  Eigen::VectorXd out(rows);
  for (int k = 0; k < rows; ++k) {
    const int a = std::max(k - 1, 0), b = std::min(k + 1, rows - 1);
    out[k] = b > a ? (values[b] - values[a]) / ((b - a) * period_s) : 0.0;
  }
  return out;
}

Eigen::VectorXd two_sided_exponential(const Eigen::VectorXd& values, double decay) {
  const int rows = static_cast<int>(values.size());
  if (rows == 0) return values;
  const int reach = static_cast<int>(std::min(static_cast<double>(rows), std::ceil(1.0 / (1.0 - decay))));
  Eigen::VectorXd out(rows);
  double state = values.head(reach).mean() / (1.0 - decay);
  for (int k = 0; k < rows; ++k) out[k] = state = values[k] + decay * state;
  state = values.tail(reach).mean() / (1.0 - decay);
  for (int k = rows - 1; k >= 0; --k) {
    state = values[k] + decay * state;
    out[k] += state - values[k];
  }
  return (1.0 - decay) / (1.0 + decay) * out;
}

double normal_density(double x, double std) {
  return elementary::exp(-0.5 * Eigen::numext::abs2(x / std)) / (std * std::sqrt(2.0 * std::numbers::pi));
}

double normal_cdf(double x) {
  static const NormalTable table;
  return table.at(x);
}

}  // namespace faultline
