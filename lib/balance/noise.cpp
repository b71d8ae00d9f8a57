// SPDX-License-Identifier: MIT
#include "lib/balance/noise.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRare = 50.0;       // times the median square: larger squares are clipped to it
constexpr double kLeastShare = 0.1;  // least constant part, as a share of the median square
constexpr double kRidge = 1e-4;      // of the variance, on the diagonal of the autocorrelation

constexpr int kTerms = 6;  // parts of a row's variance: constant, torque, rest, speed, timing, others' speed
using Terms = Eigen::Matrix<double, kTerms, 1>;
using TermMatrix = Eigen::Matrix<double, kTerms, kTerms>;
constexpr double kLeastTiming = 0.01;  // samples^2: the time of a step is uncertain by a tenth of a sample

Terms variance_terms(const BalanceRows& rows, const RowSetting& setting, int k, int j) {
  const double still = elementary::tanh(rows.dq(k, j) / setting.friction_width[j]);
  Terms out;
  out << 1.0, rows.torque(k, j) * rows.torque(k, j), 1.0 - still * still, rows.dq(k, j) * rows.dq(k, j),
      rows.step_square(k, j), rows.dq.row(k).squaredNorm() - rows.dq(k, j) * rows.dq(k, j);
  return out;
}

/// Solves non-negative least squares of a few unknowns: the best of all subsets that may differ from zero.
Terms non_negative(const TermMatrix& a, const Terms& b) {
  Terms best = Terms::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (int set = 1; set < 1 << kTerms; ++set) {
    std::vector<int> used;
    for (int i = 0; i < kTerms; ++i)
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

bool counts(const LogResidual& log, int k, int j) {
  return !log.rows->lost[k] && !log.rows->is_silent(k, j) && (log.not_counted.empty() || !log.not_counted[k]);
}

/// A row of one joint whose squared residual says how large the noise is.
struct SquaredRow {
  const LogResidual* log = nullptr;
  int row = 0;
  double residual = 0.0;    ///< squared
  double innovation = 0.0;  ///< squared: of what the rows before it, by a filter, do not predict
};

/// Returns the rows of joint `j` that have weight, and that many rows before them as the filter has terms.
std::vector<SquaredRow> squared_rows(const std::vector<LogResidual>& logs, const VectorXd& filter, int j) {
  std::vector<SquaredRow> out;
  const Eigen::Index order = std::max<Eigen::Index>(filter.size() - 1, 0);
  for (const LogResidual& log : logs) {
    Eigen::Index known = 0;
    for (int k = 0; k < log.rows->rows(); ++k) {
      known = counts(log, k, j) ? known + 1 : 0;
      if (known <= order) continue;
      double innovation = log.torque(k, j);
      for (Eigen::Index lag = 1; lag <= order; ++lag) innovation += filter[lag] * log.torque(k - lag, j);
      out.push_back({&log, k, Eigen::numext::abs2(log.torque(k, j)), Eigen::numext::abs2(innovation)});
    }
  }
  return out;
}

/// Returns the factor by which variances of innovations become variances of residuals on average.
double scale_of(const std::vector<SquaredRow>& rows, const Terms& share, const RowSetting& setting, int j) {
  double out = 0.0;
  for (const SquaredRow& row : rows)
    out += row.residual / share.dot(variance_terms(*row.log->rows, setting, row.row, j));
  return out / static_cast<double>(rows.size());
}

}  // namespace

MatrixXd row_std(const BalanceRows& rows, const RowSetting& setting, const RowNoise& noise,
                 const VectorXd& loudness) {
  MatrixXd out(rows.rows(), rows.joints());
  for (int j = 0; j < rows.joints(); ++j) {
    const JointNoise& n = noise.joint[j];
    Terms share;
    share << n.base * loudness[j] * loudness[j], n.torque, n.rest, n.speed, n.timing, n.others;
    for (int k = 0; k < rows.rows(); ++k) {
      out(k, j) = std::sqrt(share.dot(variance_terms(rows, setting, k, j)));
      if (rows.lost[k] || rows.is_silent(k, j)) out(k, j) = kNoWeight;
    }
  }
  return out;
}

Whitener::Whitener(const VectorXd& std, const JointNoise& noise)
    : weight_(std.cwiseInverse()), filter_(noise.filter), innovation_(noise.innovation) {
  const auto order = static_cast<std::size_t>(filter_.size() - 1);
  const VectorXd first = autocovariance(noise);
  std::vector<double> covariance(first.begin(), first.end());
  const auto at = [&](Eigen::Index lag) {  // by the autoregression itself
    while (lag >= std::ssize(covariance)) {
      double next = 0.0;
      for (std::size_t i = 1; i <= order; ++i)
        next -= filter_[static_cast<Eigen::Index>(i)] * covariance[covariance.size() - i];
      covariance.push_back(next);
    }
    return covariance[static_cast<std::size_t>(lag)];
  };
  std::vector<Eigen::Index> before;  // the last rows that have weight, the latest first
  for (Eigen::Index row = 0; row < weight_.size(); ++row) {
    const auto known = static_cast<Eigen::Index>(before.size());
    const bool is_regular = before.size() == order && (order == 0 || before.back() == row - known);
    if (weight_[row] == 0.0) {
      irregular_.push_back({.row = row});
      continue;
    }
    if (!is_regular) {
      MatrixXd among(known, known);
      VectorXd with(known);
      for (Eigen::Index i = 0; i < known; ++i) {
        with[i] = at(row - before[i]);
        for (Eigen::Index k = 0; k < known; ++k) among(i, k) = at(std::abs(before[i] - before[k]));
      }
      const VectorXd share = among.ldlt().solve(with);
      Irregular other{row, {}, std::sqrt(at(0) - share.dot(with))};
      for (Eigen::Index i = 0; i < known; ++i) other.predictors.emplace_back(before[i], share[i]);
      irregular_.push_back(std::move(other));
    }
    before.insert(before.begin(), row);
    if (before.size() > order) before.pop_back();
  }
}

MatrixXd Whitener::of(const MatrixXd& columns, Eigen::Index begin) const {
  const Eigen::Index rows = columns.rows();
  const MatrixXd scaled =
      (columns.array().colwise() * (weight_.segment(begin, rows).array() / innovation_)).matrix();
  MatrixXd out = scaled;
  for (Eigen::Index lag = 1; lag < filter_.size() && lag < rows; ++lag)
    out.bottomRows(rows - lag) += filter_[lag] * scaled.topRows(rows - lag);
  for (const Irregular& other : irregular_) {
    if (other.row < begin || other.row >= begin + rows) continue;
    auto row = out.row(other.row - begin);
    row = scaled.row(other.row - begin);
    for (const auto& [from, share] : other.predictors)
      if (from >= begin) row -= share * scaled.row(from - begin);
    row *= innovation_ / other.innovation;
  }
  return out;
}

Eigen::Index Whitener::reach(Eigen::Index row) const {
  for (Eigen::Index known = 1; known < filter_.size() && row < weight_.size(); ++row)
    if (weight_[row] > 0.0) ++known;
  return row;
}

std::vector<Whitener> whiteners(const MatrixXd& std, const RowNoise& noise) {
  std::vector<Whitener> out;
  for (Eigen::Index j = 0; j < std.cols(); ++j) out.emplace_back(std.col(j), noise.joint[j]);
  return out;
}

RowNoise with_variance(const std::vector<LogResidual>& logs, const RowSetting& setting, RowNoise noise) {
  const int joints = setting.joints();
  noise.joint.resize(joints);
  for (int j = 0; j < joints; ++j) {
    const std::vector<SquaredRow> rows = squared_rows(logs, noise.joint[j].filter, j);
    if (rows.empty()) continue;
    std::vector<double> squares;
    for (const SquaredRow& row : rows) squares.push_back(row.innovation);
    const double median = upper_median(std::move(squares));
    TermMatrix a = TermMatrix::Zero();
    Terms b = Terms::Zero();
    for (const SquaredRow& row : rows) {
      const Terms x = variance_terms(*row.log->rows, setting, row.row, j);
      const double weight = 1.0 / Eigen::numext::abs2(2.25 * median);
      a += weight * x * x.transpose();
      b += weight * std::min(row.innovation, kRare * median) * x;
    }
    Terms share = non_negative(a, b);
    share[0] = std::max(share[0], kLeastShare * median);
    if (noise.joint[j].filter.size() > 1) share *= scale_of(rows, share, setting, j);
    JointNoise& out = noise.joint[j];
    out.base = share[0];
    out.torque = share[1];
    out.rest = share[2];
    out.speed = share[3];
    out.timing = std::max(share[4], kLeastTiming);
    out.others = share[5];
  }
  return noise;
}

RowNoise with_filter(const std::vector<LogResidual>& logs, int order, RowNoise noise) {
  for (std::size_t j = 0; j < noise.joint.size(); ++j) {
    VectorXd correlation = VectorXd::Zero(order + 1);
    double rows = 0.0;
    for (const LogResidual& log : logs) {
      const auto joint = static_cast<Eigen::Index>(j);
      const VectorXd x = log.torque.col(joint).cwiseQuotient(log.std.col(joint));
      rows += static_cast<double>((log.std.col(joint).array() < kNoWeight).count());
      correlation += lag_products(x, order);
    }
    noise.joint[j] = with_autocovariance(std::move(noise.joint[j]), correlation / rows);
  }
  return noise;
}

VectorXd lag_products(const VectorXd& rows, Eigen::Index order) {
  VectorXd out = VectorXd::Zero(order + 1);
  for (Eigen::Index lag = 0; lag <= order && lag < rows.size(); ++lag)
    out[lag] = rows.head(rows.size() - lag).dot(rows.tail(rows.size() - lag));
  return out;
}

VectorXd autocovariance(const JointNoise& noise) {
  const Eigen::Index order = noise.filter.size() - 1;
  MatrixXd a = MatrixXd::Zero(order + 1, order + 1);
  for (Eigen::Index row = 0; row <= order; ++row)
    for (Eigen::Index lag = 0; lag <= order; ++lag) a(row, std::abs(row - lag)) += noise.filter[lag];
  const double variance = Eigen::numext::abs2(noise.innovation);
  return a.fullPivLu().solve(variance * VectorXd::Unit(order + 1, 0));
}

double most_hidden_by_white_noise(const RowNoise& noise) {
  double out = 1.0;
  for (const JointNoise& joint : noise.joint)
    out =
        std::max(out, autocovariance(joint)[0] * Eigen::numext::abs2(joint.filter.sum() / joint.innovation));
  return out;
}

JointNoise with_autocovariance(JointNoise noise, VectorXd covariance) {
  const Eigen::Index order = covariance.size() - 1;
  covariance[0] *= 1.0 + kRidge;
  MatrixXd toeplitz(order, order);
  for (Eigen::Index i = 0; i < order; ++i)
    for (Eigen::Index k = 0; k < order; ++k) toeplitz(i, k) = covariance[std::abs(i - k)];
  const VectorXd a = toeplitz.ldlt().solve(covariance.tail(order));
  noise.filter.resize(order + 1);
  noise.filter << 1.0, -a;
  noise.innovation = std::sqrt(covariance[0] - a.dot(covariance.tail(order)));
  return noise;
}

}  // namespace faultline
