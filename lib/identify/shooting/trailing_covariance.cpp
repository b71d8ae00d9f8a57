// SPDX-License-Identifier: MIT
#include "lib/identify/shooting/trailing_covariance.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

namespace faultline {
namespace {

using Matrix = Eigen::MatrixXd;

/// Returns R of J = Q R, at most as many rows as columns.
Matrix triangle_of(const Matrix& j) {
  if (j.rows() == 0) return j;
  const Matrix r = Eigen::HouseholderQR<Matrix>(j).matrixQR().triangularView<Eigen::Upper>();
  return r.topRows(std::min(r.rows(), r.cols()));
}

/// Returns the value below which a diagonal entry of R shows that its column depends on those before it.
double tolerance_of(const std::vector<Matrix>& groups, Eigen::Index trailing) {
  constexpr double kTimes = 20.0;  // times rows and columns, rounding and largest column, as in SuiteSparseQR
  Eigen::RowVectorXd squares =
      Eigen::RowVectorXd::Zero(trailing);  // of the trailing columns, then the others
  Eigen::Index rows = 0;
  for (const Matrix& group : groups) {
    const Eigen::RowVectorXd of_group = group.colwise().squaredNorm();
    const Eigen::Index leading = group.cols() - trailing;
    squares.head(trailing) += of_group.tail(trailing);
    squares.conservativeResize(squares.size() + leading);
    squares.tail(leading) = of_group.head(leading);
    rows += group.rows();
  }
  return kTimes * static_cast<double>(rows + squares.size()) * std::numeric_limits<double>::epsilon() *
         std::sqrt(squares.maxCoeff());
}

bool has_full_rank(const Matrix& r, Eigen::Index columns, double tolerance) {
  return r.rows() >= columns && (r.diagonal().head(columns).array().abs() > tolerance).all();
}

}  // namespace

bool trailing_covariance(const std::vector<Matrix>& groups, Eigen::Index trailing, Matrix& out) {
  const double tolerance = tolerance_of(groups, trailing);
  Matrix kept = Matrix::Zero(0, trailing);  // remainder of all rows after elimination of the leading columns
  for (const Matrix& group : groups) {
    const Eigen::Index leading = group.cols() - trailing;
    const Matrix r = triangle_of(group);
    if (!has_full_rank(r, leading, tolerance)) return false;
    const Eigen::Index more = r.rows() - leading;
    Matrix stacked(kept.rows() + more, trailing);
    stacked.topRows(kept.rows()) = kept;
    stacked.bottomRows(more) = r.bottomRightCorner(more, trailing);
    kept = triangle_of(stacked);
  }
  if (!has_full_rank(kept, trailing, tolerance)) return false;
  const Matrix half = kept.triangularView<Eigen::Upper>().solve(Matrix::Identity(trailing, trailing));
  out = half * half.transpose();
  return out.allFinite();
}

}  // namespace faultline
