// SPDX-License-Identifier: MIT
#include "lib/explain/search/white_search.hpp"

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

/// Normal equations of columns over some rows, with the effects not yet taken away. The sums of many onsets
/// stand side by side in one matrix, each of them in a column.
class SwitchedSums {
 public:
  SwitchedSums(Eigen::Index sizes, Eigen::Index effects, Eigen::Index onsets)
      : sizes_(sizes), effects_(effects), sums_(MatrixXd::Zero(sizes * (sizes + effects + 1), onsets)) {}

  /// Row `t` added to the sums of one onset.
  void add_row(const WhiteSearch& s, const StackedColumns& columns, int t, Eigen::Index onset) {
    const int rows = s.fit.count();
    Eigen::Map<MatrixXd> square(at(onset), sizes_, sizes_),
        cross(at(onset) + sizes_ * sizes_, effects_, sizes_);
    Eigen::Map<VectorXd> vector(at(onset) + sizes_ * (sizes_ + effects_), sizes_);
    for (int j = 0; j < s.fit.joints(); ++j) {
      const double std = s.fit.std()(t, j), weight = s.precision[j] / (std * std);
      for (Eigen::Index a = 0; a < sizes_; ++a) {
        const double x = columns(j * rows + t, a);
        if (x == 0.0) continue;
        for (Eigen::Index b = 0; b < sizes_; ++b) square(b, a) += weight * x * columns(j * rows + t, b);
        vector[a] += weight * x * s.left[j * rows + t];
        cross.col(a) += weight * x * s.effects[j].col(t);
      }
    }
  }
  void begin_with(Eigen::Index onset, Eigen::Index other) { sums_.col(onset) = sums_.col(other); }
  /// Those of one onset without those of a later one.
  SwitchedSums between(Eigen::Index onset, Eigen::Index end) const {
    SwitchedSums out(sizes_, effects_, 1);
    out.sums_.col(0) = sums_.col(onset) - sums_.col(end);
    return out;
  }
  /// Of the first onset: the matrix without what the effects of the day explain, its quadratic form, the
  /// vector.
  MatrixXd without_effects() const { return square() - cross().transpose() * cross(); }
  double quadratic_form(const VectorXd& of) const {
    double known = 0.0;
    for (Eigen::Index e = 0; e < effects_; ++e) known += Eigen::numext::abs2(cross().row(e).dot(of));
    return of.dot(square().lazyProduct(of)) - known;
  }
  Eigen::Map<const VectorXd> vector() const {
    return Eigen::Map<const VectorXd>(sums_.data() + sizes_ * (sizes_ + effects_), sizes_);
  }

 private:
  double* at(Eigen::Index onset) { return sums_.data() + onset * sums_.rows(); }
  Eigen::Map<const MatrixXd> square() const { return {sums_.data(), sizes_, sizes_}; }
  Eigen::Map<const MatrixXd> cross() const { return {sums_.data() + sizes_ * sizes_, effects_, sizes_}; }

  Eigen::Index sizes_, effects_;
  MatrixXd sums_;
};

/// Nats by which columns explain more, their sizes and the effects integrated out.
double gain_of(const SwitchedSums& sums, const VectorXd& variance) {
  MatrixXd inner = sums.without_effects();
  inner.diagonal() += variance.cwiseInverse();
  const Eigen::LLT<MatrixXd> factor(inner);
  double volume = 0.0;
  for (int i = 0; i < variance.size(); ++i)
    volume += elementary::log(factor.matrixLLT()(i, i)) + 0.5 * elementary::log(variance[i]);
  return 0.5 * sums.vector().dot(factor.solve(sums.vector())) - volume;
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
    out.effects.push_back(factor.matrixL().solve(fit.effect_columns()[j].transpose()));
  return out;
}

std::vector<VectorXd> onset_gains(const WhiteSearch& s, const FaultColumns& columns,
                                  const std::vector<int>& lengths) {
  const int rows = s.fit.count();
  std::vector<VectorXd> out(lengths.size(), VectorXd(rows));
  SwitchedSums from(columns.column.cols(), s.effects.front().rows(), rows + 1);  // row t and all later rows
  for (int t = rows - 1; t >= 0; --t) {
    from.begin_with(t, t + 1);
    from.add_row(s, columns.column, t, t);
  }
  for (std::size_t l = 0; l < lengths.size(); ++l)
    for (int t = 0; t < rows; ++t)
      out[l][t] =
          gain_of(from.between(t, lengths[l] > 0 ? std::min(t + lengths[l], rows) : rows), columns.variance);
  return out;
}

VectorXd onset_gains_of_size(const WhiteSearch& s, const StackedColumns& columns, const MatrixXd& size) {
  VectorXd out(s.fit.count());
  SwitchedSums sums(columns.cols(), s.effects.front().rows(), 1);
  for (int t = s.fit.count() - 1; t >= 0; --t) {
    sums.add_row(s, columns, t, 0);
    const VectorXd of_onset = size.row(t).transpose();
    out[t] = of_onset.dot(sums.vector()) - 0.5 * sums.quadratic_form(of_onset);
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
