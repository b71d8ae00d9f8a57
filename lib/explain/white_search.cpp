// SPDX-License-Identifier: MIT
#include "lib/explain/white_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kApart_s = 0.15;  // between two onsets of one kind and joint
constexpr int kImpulse = 2000;     // rows of the filter's response that its variance is summed over
constexpr int kFirstOnsetRow = 6;  // rows
constexpr double kNothing = -std::numeric_limits<double>::infinity();

/// Variance of a process whose innovations are one, from its autoregression.
double process_variance(const VectorXd& filter) {
  std::vector<double> h(kImpulse, 0.0);
  double sum = 0.0;
  for (int k = 0; k < kImpulse; ++k) {
    double v = k == 0 ? 1.0 : 0.0;
    for (int lag = 1; lag < filter.size() && lag <= k; ++lag) v -= filter[lag] * h[k - lag];
    h[k] = v;
    sum += v * v;
  }
  return sum;
}

/// Normal equations of columns that are switched on at a row, effects of the day not yet taken away.
struct SwitchedSums {
  MatrixXd square, cross;
  VectorXd vector;

  void add_row(const WhiteSearch& s, const StackedColumns& columns, int t) {
    const int rows = s.fit.count();
    for (int j = 0; j < s.fit.joints(); ++j) {
      const Eigen::RowVectorXd x = columns.row(j * rows + t);
      if (x.isZero(0.0)) continue;
      const double std = s.fit.std()(t, j), weight = s.precision[j] / (std * std);
      square += weight * x.transpose() * x;
      vector += weight * s.left[j * rows + t] * x.transpose();
      cross += weight * x.transpose() * s.fit.day_columns()[j].row(t);
    }
  }
  MatrixXd without_day(const WhiteSearch& s) const {
    return square - cross * s.covariance * cross.transpose();
  }
};

SwitchedSums no_rows(const WhiteSearch& s, const StackedColumns& columns) {
  const Eigen::Index k = columns.cols();
  return {MatrixXd::Zero(k, k), MatrixXd::Zero(k, s.covariance.rows()), VectorXd::Zero(k)};
}

}  // namespace

VectorXd WhiteSearch::weighted(int joint) const {
  const int rows = fit.count();
  return precision[joint] * left.segment(joint * rows, rows).cwiseQuotient(fit.std().col(joint).cwiseAbs2());
}

WhiteSearch white_search(const LogFit& fit) {
  const BalanceModel& m = fit.model();
  WhiteSearch out{fit, VectorXd(fit.joints()), {}, {}};
  MatrixXd a = m.day_variance.cwiseInverse().asDiagonal();
  VectorXd b = VectorXd::Zero(a.rows());
  Stacked y = fit.residual();
  if (fit.has_piece()) y -= fit.piece_torque(fit.healthy().piece_level);
  for (int j = 0; j < fit.joints(); ++j) {
    const JointNoise& noise = m.noise.joint[j];
    out.precision[j] = 1.0 / (noise.innovation * noise.innovation * process_variance(noise.filter));
    const VectorXd inverse = fit.std().col(j).cwiseInverse();
    const MatrixXd w = inverse.asDiagonal() * fit.day_columns()[j];
    a += out.precision[j] * w.transpose() * w;
    b += out.precision[j] * w.transpose() * y.segment(j * fit.count(), fit.count()).cwiseProduct(inverse);
  }
  out.covariance = a.ldlt().solve(MatrixXd::Identity(a.rows(), a.cols()));
  out.left = y - fit.day_torque(out.covariance * b);
  return out;
}

VectorXd onset_gains(const WhiteSearch& s, const FaultColumns& columns) {
  VectorXd out(s.fit.count());
  double log_prior = 0.0;
  for (const double variance : columns.variance) log_prior += 0.5 * elementary::log(variance);
  SwitchedSums sums = no_rows(s, columns.column);
  for (int t = s.fit.count() - 1; t >= 0; --t) {
    sums.add_row(s, columns.column, t);
    MatrixXd inner = sums.without_day(s);
    inner.diagonal() += columns.variance.cwiseInverse();
    const Eigen::LLT<MatrixXd> factor(inner);
    double log_posterior = 0.0;
    for (int i = 0; i < columns.sizes(); ++i) log_posterior += elementary::log(factor.matrixLLT()(i, i));
    out[t] = 0.5 * sums.vector.dot(factor.solve(sums.vector)) - log_posterior - log_prior;
  }
  return out;
}

VectorXd onset_gains_of_size(const WhiteSearch& s, const StackedColumns& columns, const MatrixXd& size) {
  VectorXd out(s.fit.count());
  SwitchedSums sums = no_rows(s, columns);
  for (int t = s.fit.count() - 1; t >= 0; --t) {
    sums.add_row(s, columns, t);
    const VectorXd of_onset = size.row(t).transpose();
    out[t] = of_onset.dot(sums.vector) - 0.5 * of_onset.dot(sums.without_day(s) * of_onset);
  }
  return out;
}

std::vector<Candidate> peaks(const LogFit& fit, Candidate candidate, VectorXd score, int most) {
  const double row_s = fit.model().setting.row_s();
  const int first = std::max(kFirstOnsetRow, static_cast<int>(kLead_s / row_s)), last = fit.count() - kTail;
  const int apart = std::max(1, static_cast<int>(kApart_s / row_s));
  for (int k = 0; k < fit.count(); ++k)
    if (k < first || k >= last || !(score[k] > kNothing)) score[k] = kNothing;
  std::vector<Candidate> out;
  for (int n = 0; n < most; ++n) {
    Eigen::Index at = 0;
    candidate.score = score.maxCoeff(&at);
    if (candidate.score == kNothing) break;
    candidate.onset_s = fit.time_s()[at];
    out.push_back(candidate);
    const int a = std::max(0, static_cast<int>(at) - apart);
    const int b = std::min(fit.count(), static_cast<int>(at) + apart + 1);
    score.segment(a, b - a).setConstant(kNothing);
  }
  return out;
}

}  // namespace faultline
