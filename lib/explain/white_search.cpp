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
constexpr int kFirstOnsetRow = 6;  // rows
constexpr double kNothing = -std::numeric_limits<double>::infinity();

/// Normal equations of columns over some rows; with the effects not yet taken away.
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
      cross += weight * x.transpose() * s.effects[j].row(t);
    }
  }
  MatrixXd without_effects() const { return square - cross * cross.transpose(); }
};

SwitchedSums no_rows(const WhiteSearch& s, const StackedColumns& columns) {
  const Eigen::Index k = columns.cols();
  return {MatrixXd::Zero(k, k), MatrixXd::Zero(k, s.effects.front().cols()), VectorXd::Zero(k)};
}

/// Nats by which columns explain more, their sizes and the effects integrated out.
double gain_of(const SwitchedSums& sums, const VectorXd& variance) {
  MatrixXd inner = sums.without_effects();
  inner.diagonal() += variance.cwiseInverse();
  const Eigen::LLT<MatrixXd> factor(inner);
  double volume = 0.0;
  for (int i = 0; i < variance.size(); ++i)
    volume += elementary::log(factor.matrixLLT()(i, i)) + 0.5 * elementary::log(variance[i]);
  return 0.5 * sums.vector.dot(factor.solve(sums.vector)) - volume;
}

}  // namespace

VectorXd WhiteSearch::weighted(int joint) const {
  const int rows = fit.count();
  return precision[joint] * left.segment(joint * rows, rows).cwiseQuotient(fit.std().col(joint).cwiseAbs2());
}

WhiteSearch white_search(const LogFit& fit) {
  WhiteSearch out{fit, VectorXd(fit.joints()), {}, {}};
  MatrixXd a = fit.effect_variance().cwiseInverse().asDiagonal();
  VectorXd b = VectorXd::Zero(a.rows());
  Stacked y = fit.residual();
  if (fit.has_piece()) y -= fit.piece_torque(fit.healthy().piece_level);
  for (int j = 0; j < fit.joints(); ++j) {
    out.precision[j] = 1.0 / autocovariance(fit.noise().joint[j])[0];
    const VectorXd inverse = fit.std().col(j).cwiseInverse();
    const MatrixXd w = inverse.asDiagonal() * fit.effect_columns()[j];
    a += out.precision[j] * w.transpose() * w;
    b += out.precision[j] * w.transpose() * y.segment(j * fit.count(), fit.count()).cwiseProduct(inverse);
  }
  const Eigen::LLT<MatrixXd> factor(a);
  out.left = y - fit.day_torque(factor.solve(b));
  for (int j = 0; j < fit.joints(); ++j)
    out.effects.push_back(factor.matrixL().solve(fit.effect_columns()[j].transpose()).transpose());
  return out;
}

std::vector<VectorXd> onset_gains(const WhiteSearch& s, const FaultColumns& columns,
                                  const std::vector<int>& lengths) {
  const int rows = s.fit.count();
  std::vector<VectorXd> out(lengths.size(), VectorXd(rows));
  std::vector<SwitchedSums> from(rows + 1, no_rows(s, columns.column));  // by row: it and all later rows
  for (int t = rows - 1; t >= 0; --t) {
    from[t] = from[t + 1];
    from[t].add_row(s, columns.column, t);
  }
  for (std::size_t l = 0; l < lengths.size(); ++l)
    for (int t = 0; t < rows; ++t) {
      const int end = lengths[l] > 0 ? std::min(t + lengths[l], rows) : rows;
      const SwitchedSums within{from[t].square - from[end].square, from[t].cross - from[end].cross,
                                from[t].vector - from[end].vector};
      out[l][t] = gain_of(within, columns.variance);
    }
  return out;
}

VectorXd onset_gains_of_size(const WhiteSearch& s, const StackedColumns& columns, const MatrixXd& size) {
  VectorXd out(s.fit.count());
  SwitchedSums sums = no_rows(s, columns);
  for (int t = s.fit.count() - 1; t >= 0; --t) {
    sums.add_row(s, columns, t);
    const VectorXd of_onset = size.row(t).transpose();
    out[t] = of_onset.dot(sums.vector) - 0.5 * of_onset.dot(sums.without_effects() * of_onset);
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
