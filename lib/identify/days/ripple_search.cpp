// SPDX-License-Identifier: MIT
#include "lib/identify/days/ripple_search.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

constexpr double kLeastExplained = 0.05;  // of the squares left over: a ripple that explains less is none
constexpr double kCut = 4.0;              // standard deviations

/// What is left of one joint in the rows that count.
struct Column {
  std::vector<double> q, dq, torque, left;
};

Column column_of(const std::vector<LeftOver>& logs, int j) {
  Column out;
  for (const LeftOver& log : logs)
    for (int k = 0; k < log.rows->rows(); ++k) {
      if (log.rows->lost[k] || (!log.not_counted.empty() && log.not_counted[k])) continue;
      out.q.push_back(log.rows->q(k, j));
      out.dq.push_back(log.rows->dq(k, j));
      out.torque.push_back(log.rows->torque(k, j));
      out.left.push_back(log.torque(k, j));
    }
  return out;
}

/// Mean zero, and no value beyond kCut standard deviations.
void centre_and_cut(std::vector<double>& values) {
  Eigen::Map<Eigen::ArrayXd> v(values.data(), static_cast<Eigen::Index>(values.size()));
  v -= v.mean();
  const double most = kCut * std::sqrt(v.square().mean());
  v = v.max(-most).min(most);
}

/// Square that a ripple of this rate explains; the kernel weakens fast ones.
double explained(const Column& c, double rate, double kernel_s) {
  Eigen::Matrix4d a = 1e-6 * Eigen::Matrix4d::Identity();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  for (std::size_t k = 0; k < c.q.size(); ++k) {
    const double slow = rate * c.dq[k] * kernel_s, gain = elementary::exp(-0.5 * slow * slow);
    const auto [s, co] = elementary::sin_cos(rate * c.q[k]);
    const Eigen::Vector4d x(gain * s * c.torque[k], gain * co * c.torque[k], gain * s, gain * co);
    a += x * x.transpose();
    b += c.left[k] * x;
  }
  return b.dot(a.ldlt().solve(b));
}

}  // namespace

std::vector<RippleRate> find_ripples_in_rows(const std::vector<LeftOver>& logs, const RowSetting& setting,
                                             const Eigen::VectorXd& range) {
  std::vector<RippleRate> out;
  for (int j = 0; j < setting.joints(); ++j) {
    if (range[j] <= 0.0) continue;
    Column column = column_of(logs, j);
    if (column.left.empty()) continue;
    centre_and_cut(column.left);
    double all = 0.0;
    for (const double v : column.left) all += v * v;
    double most = 0.0, best = 0.0;
    for (double waves = 20.0; waves < 700.0; waves += 1.0) {
      const double rate = waves / range[j], e = explained(column, rate, setting.kernel_s);
      if (e > most) most = e, best = rate;
    }
    if (most > kLeastExplained * all) out.push_back({j, best});
  }
  return out;
}

}  // namespace faultline
