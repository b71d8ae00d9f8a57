// SPDX-License-Identifier: MIT
#include "lib/balance/noise.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector4d;
using Eigen::VectorXd;

constexpr double kSaysNothing = 1e6;  // times the usual standard deviation
constexpr double kRare = 50.0;        // times the median: squares above it are cut
constexpr double kLeastShare = 0.1;   // of the median square that the constant part has at least
constexpr double kRidge = 1e-4;       // of the variance, on the diagonal of the autocorrelation

Vector4d variance_terms(const BalanceRows& rows, const RowSetting& setting, int k, int j) {
  const double still = elementary::tanh(rows.dq(k, j) / setting.friction_width[j]);
  return {1.0, rows.torque(k, j) * rows.torque(k, j), 1.0 - still * still, rows.dq(k, j) * rows.dq(k, j)};
}

/// Non-negative least squares in four unknowns: the best of all sets of unknowns that may differ from zero.
Vector4d non_negative(const Eigen::Matrix4d& a, const Vector4d& b) {
  Vector4d best = Vector4d::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (int set = 1; set < 16; ++set) {
    std::vector<int> used;
    for (int i = 0; i < 4; ++i)
      if (set >> i & 1) used.push_back(i);
    const VectorXd part = a(used, used).ldlt().solve(b(used));
    if (!part.allFinite() || part.minCoeff() < 0.0) continue;
    const double value = part.dot(a(used, used) * part) - 2.0 * part.dot(b(used));
    if (value >= least) continue;
    least = value;
    best.setZero();
    for (std::size_t i = 0; i < used.size(); ++i) best[used[i]] = part[static_cast<int>(i)];
  }
  return best;
}

bool counts(const LeftOver& log, int k) {
  return !log.rows->lost[k] && (log.not_counted.empty() || !log.not_counted[k]);
}

}  // namespace

MatrixXd row_std(const BalanceRows& rows, const RowSetting& setting, const RowNoise& noise,
                 const VectorXd& loudness) {
  MatrixXd out(rows.rows(), rows.joints());
  for (int j = 0; j < rows.joints(); ++j) {
    const JointNoise& n = noise.joint[j];
    const Vector4d share(n.base * loudness[j] * loudness[j], n.torque, n.rest, n.speed);
    for (int k = 0; k < rows.rows(); ++k) {
      out(k, j) = std::sqrt(share.dot(variance_terms(rows, setting, k, j)));
      if (rows.lost[k]) out(k, j) *= kSaysNothing;
    }
  }
  return out;
}

MatrixXd whiten(const MatrixXd& columns, const VectorXd& std, const JointNoise& noise) {
  const MatrixXd scaled = (columns.array().colwise() / (noise.innovation * std.array())).matrix();
  MatrixXd out = scaled;
  const Eigen::Index rows = columns.rows();
  for (Eigen::Index lag = 1; lag < noise.filter.size() && lag < rows; ++lag)
    out.bottomRows(rows - lag) += noise.filter[lag] * scaled.topRows(rows - lag);
  return out;
}

void fit_variance(const std::vector<LeftOver>& logs, const RowSetting& setting, RowNoise& noise) {
  const int joints = setting.joints();
  noise.joint.resize(joints);
  for (int j = 0; j < joints; ++j) {
    std::vector<double> squares;
    for (const LeftOver& log : logs)
      for (int k = 0; k < log.rows->rows(); ++k)
        if (counts(log, k)) squares.push_back(log.torque(k, j) * log.torque(k, j));
    if (squares.empty()) continue;
    const double median = upper_median(squares);
    Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
    Vector4d b = Vector4d::Zero();
    for (const LeftOver& log : logs)
      for (int k = 0; k < log.rows->rows(); ++k) {
        if (!counts(log, k)) continue;
        const Vector4d x = variance_terms(*log.rows, setting, k, j);
        const double y = std::min(log.torque(k, j) * log.torque(k, j), kRare * median);
        const double weight = 1.0 / std::pow(2.25 * median, 2);
        a += weight * x * x.transpose();
        b += weight * y * x;
      }
    const Vector4d share = non_negative(a, b);
    JointNoise& out = noise.joint[j];
    out.base = std::max(share[0], kLeastShare * median);
    out.torque = share[1];
    out.rest = share[2];
    out.speed = share[3];
  }
}

void fit_filter(const std::vector<LeftOver>& logs, int order, RowNoise& noise) {
  for (std::size_t j = 0; j < noise.joint.size(); ++j) {
    VectorXd correlation = VectorXd::Zero(order + 1);
    double rows = 0.0;
    for (const LeftOver& log : logs) {
      const VectorXd x = log.torque.col(j).cwiseQuotient(log.std.col(j));
      rows += static_cast<double>(x.size());
      for (int lag = 0; lag <= order && lag < x.size(); ++lag)
        correlation[lag] += x.head(x.size() - lag).dot(x.tail(x.size() - lag));
    }
    correlation /= rows;
    correlation[0] *= 1.0 + kRidge;
    MatrixXd toeplitz(order, order);
    for (int i = 0; i < order; ++i)
      for (int k = 0; k < order; ++k) toeplitz(i, k) = correlation[std::abs(i - k)];
    const VectorXd a = toeplitz.ldlt().solve(correlation.tail(order));
    JointNoise& out = noise.joint[j];
    out.filter.resize(order + 1);
    out.filter << 1.0, -a;
    out.innovation = std::sqrt(correlation[0] - a.dot(correlation.tail(order)));
  }
}

}  // namespace faultline
