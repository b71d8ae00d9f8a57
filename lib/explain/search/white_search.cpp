// SPDX-License-Identifier: MIT
#include "lib/explain/search/white_search.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::Ref;
using Eigen::VectorXd;

constexpr double kApart_s = 0.15;  // between two onsets of one kind and joint
constexpr double kNothing = -std::numeric_limits<double>::infinity();  // score of a row that is no onset

/// Normal equations of some columns for an onset at each row.
struct OnsetEquations {
  std::vector<MatrixXd> square;  ///< by column a: sums with the columns 0 to a, (a + 1) x onsets
  std::vector<MatrixXd> cross;   ///< by column: sums with the effects, effects x onsets
  MatrixXd vector;               ///< of each column with the residual, columns x onsets
};

OnsetEquations onset_equations(const WhiteSearch& s, const StackedColumns& columns) {
  OnsetEquations out{{}, {}, MatrixXd(columns.cols(), s.fit.count())};
  for (Eigen::Index a = 0; a < columns.cols(); ++a) {
    out.square.emplace_back(a + 1, s.fit.count());
    for (Eigen::Index b = 0; b <= a; ++b)
      out.square[a].row(b) = sums_from_each_row(s, columns.col(a), columns.col(b)).transpose();
    out.cross.push_back(effect_sums_from_each_row(s, columns.col(a)));
    out.vector.row(a) = sums_from_each_row(s, columns.col(a), s.left).transpose();
  }
  return out;
}

/// Returns the products of two columns' sums with the effects over `length` rows from each row on (0: to the
/// end), summed over the effects. `a` and `b` are the sums to the end, effects x onsets.
ArrayXd effect_products(const MatrixXd& a, const MatrixXd& b, int length) {
  const Eigen::Index ended = length > 0 ? std::max<Eigen::Index>(a.cols() - length, 0) : 0;
  ArrayXd out(a.cols());
  for (Eigen::Index t = 0; t < ended; ++t)
    out[t] = (a.col(t) - a.col(t + length)).dot(b.col(t) - b.col(t + length));
  for (Eigen::Index t = ended; t < a.cols(); ++t) out[t] = a.col(t).dot(b.col(t));
  return out;
}

/// Returns the evidence for columns over `length` rows from each onset on (0: to the end), in nats, with
/// their sizes and the effects integrated out: by a Cholesky factor of the normal equations of all onsets at
/// once.
VectorXd gains_of(const OnsetEquations& equations, const VectorXd& variance, int length) {
  const Eigen::Index sizes = variance.size(), onsets = equations.vector.cols();
  const MatrixXd vector = over_rows(equations.vector, length);
  std::vector<std::vector<ArrayXd>> factor(sizes);  // row, column, onset
  std::vector<ArrayXd> solved;
  ArrayXd gain = ArrayXd::Zero(onsets);
  for (Eigen::Index a = 0; a < sizes; ++a) {
    const MatrixXd square = over_rows(equations.square[a], length);
    for (Eigen::Index b = 0; b <= a; ++b) {
      ArrayXd left = square.row(b).array();
      left -= effect_products(equations.cross[a], equations.cross[b], length);
      for (Eigen::Index k = 0; k < b; ++k) left -= factor[a][k] * factor[b][k];
      factor[a].push_back(b == a ? ArrayXd((left + 1.0 / variance[a]).sqrt()) : ArrayXd(left / factor[b][b]));
    }
    ArrayXd right = vector.row(a).array();
    for (Eigen::Index k = 0; k < a; ++k) right -= factor[a][k] * solved[k];
    solved.push_back(right / factor[a][a]);
    gain += 0.5 * solved[a].square() - factor[a][a].unaryExpr(&elementary::log) -
            0.5 * elementary::log(variance[a]);
  }
  return gain;
}

}  // namespace

int first_onset_row(const LogFit& fit, FaultKind kind) {
  if (kind == FaultKind::collision) return 0;
  return std::max(kLeadRows, static_cast<int>(kLead_s / fit.model().setting.row_s()));
}

WhiteSearch white_search(const LogFit& fit) {
  const int rows = fit.count();
  WhiteSearch out{fit, Stacked(rows * fit.joints()), {}, {}};
  MatrixXd a = fit.effect_variance().cwiseInverse().asDiagonal();
  VectorXd b = VectorXd::Zero(a.rows());
  Stacked y = fit.residual();
  if (fit.has_piece()) y -= fit.piece_torque(fit.healthy().piece_level);
  for (int j = 0; j < fit.joints(); ++j) {
    auto weight = out.weight.segment(j * rows, rows);
    weight = fit.std().col(j).cwiseAbs2().cwiseInverse() / autocovariance(fit.noise().joint[j])[0];
    const MatrixXd& effects = fit.effects().column(j);
    const std::vector<int>& reach = fit.effects().reach(j);
    const MatrixXd weighted = weight.asDiagonal() * effects, square = effects.transpose() * weighted;
    const VectorXd product = weighted.transpose() * y.segment(j * rows, rows);
    a(reach, reach) += square;
    b(reach) += product;
  }
  const Eigen::LLT<MatrixXd> factor(a);
  out.left = y - fit.day_torque(factor.solve(b));
  for (int j = 0; j < fit.joints(); ++j)
    out.effects.push_back(factor.matrixL().solve(fit.effects().all(j).transpose()));
  return out;
}

VectorXd sums_from_each_row(const WhiteSearch& s, const Ref<const Stacked>& column,
                            const Ref<const Stacked>& other) {
  const int rows = s.fit.count();
  VectorXd out = VectorXd::Zero(rows);
  for (int j = 0; j < s.fit.joints(); ++j) {
    const auto of_joint = [&](const auto& v) { return v.segment(j * rows, rows).array(); };
    if ((of_joint(column) == 0.0).all()) continue;
    out.array() += of_joint(s.weight) * of_joint(column) * of_joint(other);
  }
  for (int t = rows - 1; t-- > 0;) out[t] += out[t + 1];
  return out;
}

MatrixXd effect_sums_from_each_row(const WhiteSearch& s, const Ref<const Stacked>& column) {
  const int rows = s.fit.count();
  std::vector<int> reached;  // joints at which the column is not zero
  for (int j = 0; j < s.fit.joints(); ++j)
    if (!column.segment(j * rows, rows).isZero(0.0)) reached.push_back(j);
  MatrixXd out = MatrixXd::Zero(s.effects.front().rows(), rows);
  for (int t = rows; t-- > 0;) {
    for (const int j : reached)
      out.col(t) += s.effects[j].col(t) * (s.weight[j * rows + t] * column[j * rows + t]);
    if (t + 1 < rows) out.col(t) += out.col(t + 1);
  }
  return out;
}

MatrixXd over_rows(const MatrixXd& sums_from_each_row, int length) {
  MatrixXd out = sums_from_each_row;
  const Eigen::Index ended = length > 0 ? std::max<Eigen::Index>(out.cols() - length, 0) : 0;
  out.leftCols(ended) -= sums_from_each_row.rightCols(ended);
  return out;
}

std::vector<VectorXd> onset_gains(const WhiteSearch& s, const FaultColumns& columns,
                                  const std::vector<int>& lengths) {
  const OnsetEquations equations = onset_equations(s, columns.column);
  std::vector<VectorXd> out;
  for (const int length : lengths) out.push_back(gains_of(equations, columns.variance, length));
  return out;
}

std::vector<Candidate> peaks(const LogFit& fit, const FaultClaim& claim, VectorXd score, int most) {
  const double row_s = fit.model().setting.row_s();
  const int first = first_onset_row(fit, claim.kind), last = fit.count() - kTail;
  const int apart = std::max(1, static_cast<int>(kApart_s / row_s));
  for (int k = 0; k < fit.count(); ++k)
    if (k < first || k >= last || !(score[k] > kNothing)) score[k] = kNothing;
  std::vector<Candidate> out;
  Candidate candidate{claim};
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
