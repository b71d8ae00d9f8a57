// SPDX-License-Identifier: MIT
#include "lib/identify/weak_form/column_selection.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "lib/core/matrix/decompositions.hpp"

namespace faultline {
namespace {

constexpr double kDependent = 3e-3;   ///< least share of a scaled column that is independent of the others
constexpr double kNotExcited = 1e-9;  ///< rms of a column, in units of the residual: less is rounding
constexpr double kMixed = 0.03;  ///< share of a column in a dependent one beyond which both are confounded

double condition(const Eigen::MatrixXd& a) {
  if (a.cols() == 0) return 0.0;
  const Eigen::VectorXd s = singular_values(a);
  return s[0] / s[s.size() - 1];
}

std::vector<int> excited_columns(const Eigen::MatrixXd& a, const std::vector<bool>& wanted) {
  std::vector<int> listed;
  for (int c = 0; c < a.cols(); ++c)
    if (wanted[c] && a.col(c).norm() > kNotExcited * std::sqrt(static_cast<double>(a.rows())))
      listed.push_back(c);
  return listed;
}

/// Selects those of the `listed` columns, here scaled, that are no mixture of others.
void select_independent(const Eigen::MatrixXd& scaled, const std::vector<int>& listed, ColumnSelection& out) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled);
  const Eigen::MatrixXd r = qr.matrixR().topRows(scaled.cols()).triangularView<Eigen::Upper>();
  const auto order = qr.colsPermutation().indices();
  int rank = 0;
  while (rank < scaled.cols() && std::abs(r(rank, rank)) > kDependent) ++rank;
  for (int i = 0; i < rank; ++i) {
    out.columns.push_back(listed[order[i]]);
    out.confounded[listed[order[i]]] = false;
  }
  if (rank < scaled.cols()) {  // the others are mixtures of those
    const Eigen::MatrixXd mixture = r.topLeftCorner(rank, rank)
                                        .triangularView<Eigen::Upper>()
                                        .solve(r.topRightCorner(rank, scaled.cols() - rank));
    for (int i = 0; i < rank; ++i)
      if (mixture.row(i).cwiseAbs().maxCoeff() > kMixed) out.confounded[listed[order[i]]] = true;
  }
  std::sort(out.columns.begin(), out.columns.end());
}

/// Returns those of the `listed` columns that were chosen and have an index below `rigid`.
Eigen::MatrixXd base_columns(const Eigen::MatrixXd& scaled, const std::vector<int>& listed,
                             const std::vector<int>& chosen, int rigid) {
  Eigen::MatrixXd base(scaled.rows(), 0);
  for (std::size_t i = 0; i < listed.size(); ++i)
    if (listed[i] < rigid && std::binary_search(chosen.begin(), chosen.end(), listed[i])) {
      base.conservativeResize(Eigen::NoChange, base.cols() + 1);
      base.rightCols<1>() = scaled.col(i);
    }
  return base;
}

}  // namespace

ColumnSelection select_columns(const Eigen::MatrixXd& a, const std::vector<bool>& wanted, int rigid) {
  ColumnSelection out;
  out.confounded.assign(a.cols(), true);
  const std::vector<int> listed = excited_columns(a, wanted);
  if (listed.empty()) return out;
  Eigen::MatrixXd scaled(a.rows(), listed.size());
  for (std::size_t i = 0; i < listed.size(); ++i) scaled.col(i) = a.col(listed[i]).normalized();
  select_independent(scaled, listed, out);
  out.condition_number = condition(base_columns(scaled, listed, out.columns, rigid));
  return out;
}

}  // namespace faultline
