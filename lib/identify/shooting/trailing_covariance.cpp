// SPDX-License-Identifier: MIT
#include "lib/identify/shooting/trailing_covariance.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <vector>

namespace faultline {
namespace {

using Matrix = Eigen::MatrixXd;
using Rows = std::vector<int>;

/// Access to the sparse rows of J.
struct SparseRows {
  const ceres::CRSMatrix& j;
  int first;  ///< index of the first trailing column

  int begin(int row) const { return j.rows[static_cast<std::size_t>(row)]; }
  int end(int row) const { return begin(row + 1); }
  int column(int at) const { return j.cols[static_cast<std::size_t>(at)]; }
  double value(int at) const { return j.values[static_cast<std::size_t>(at)]; }
};

/// Rows that share leading columns, and these columns.
struct RowGroup {
  std::map<int, int> place;  ///< position of each leading column among those of the group
  Rows rows;
};

int root_of(std::vector<int>& parent, int column) {
  while (parent[column] != column) column = parent[column] = parent[parent[column]];
  return column;
}

/// Returns groups that share no leading column; first the rows that have none at all.
std::vector<RowGroup> groups_of(const SparseRows& s) {
  std::vector<int> parent(s.first), of_row(s.j.num_rows, -1);
  std::iota(parent.begin(), parent.end(), 0);
  for (int row = 0; row < s.j.num_rows; ++row)
    for (int at = s.begin(row); at < s.end(row); ++at) {
      if (s.column(at) >= s.first) continue;
      if (of_row[row] < 0) of_row[row] = s.column(at);
      parent[root_of(parent, s.column(at))] = root_of(parent, of_row[row]);
    }
  std::vector<RowGroup> groups(1);
  std::vector<int> group_of(s.first, -1);
  for (int column = 0; column < s.first; ++column) {
    int& group = group_of[root_of(parent, column)];
    if (group < 0) {
      group = static_cast<int>(groups.size());
      groups.emplace_back();
    }
    auto& place = groups[group].place;
    place.emplace(column, static_cast<int>(place.size()));
  }
  for (int row = 0; row < s.j.num_rows; ++row)
    groups[of_row[row] < 0 ? 0 : group_of[root_of(parent, of_row[row])]].rows.push_back(row);
  return groups;
}

/// Returns the rows of a group as a dense matrix: its leading columns, then the trailing ones.
Matrix dense_rows(const SparseRows& s, const RowGroup& group) {
  const auto leading = static_cast<Eigen::Index>(group.place.size());
  Matrix out = Matrix::Zero(static_cast<Eigen::Index>(group.rows.size()), leading + s.j.num_cols - s.first);
  for (std::size_t k = 0; k < group.rows.size(); ++k)
    for (int at = s.begin(group.rows[k]); at < s.end(group.rows[k]); ++at) {
      const int column = s.column(at);
      out(static_cast<Eigen::Index>(k),
          column >= s.first ? leading + column - s.first : group.place.at(column)) += s.value(at);
    }
  return out;
}

/// Returns R of J = Q R, at most as many rows as columns.
Matrix triangle_of(const Matrix& j) {
  if (j.rows() == 0) return j;
  const Matrix r = Eigen::HouseholderQR<Matrix>(j).matrixQR().triangularView<Eigen::Upper>();
  return r.topRows(std::min(r.rows(), r.cols()));
}

/// Returns the value below which a diagonal entry of R shows that its column depends on those before it.
double tolerance_of(const ceres::CRSMatrix& j) {
  constexpr double kTimes = 20.0;  // times rows and columns, rounding and largest column, as in SuiteSparseQR
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(j.num_cols);
  for (std::size_t at = 0; at < j.values.size(); ++at) squares[j.cols[at]] += j.values[at] * j.values[at];
  return kTimes * (j.num_rows + j.num_cols) * std::numeric_limits<double>::epsilon() *
         std::sqrt(squares.maxCoeff());
}

bool has_full_rank(const Matrix& r, Eigen::Index columns, double tolerance) {
  return r.rows() >= columns && (r.diagonal().head(columns).array().abs() > tolerance).all();
}

}  // namespace

bool trailing_covariance(const ceres::CRSMatrix& jacobian, int first, Eigen::MatrixXd& out) {
  const SparseRows rows{jacobian, first};
  const Eigen::Index trailing = jacobian.num_cols - first;
  const double tolerance = tolerance_of(jacobian);
  Matrix kept = Matrix::Zero(0, trailing);  // remainder of all rows after elimination of the leading columns
  for (const RowGroup& group : groups_of(rows)) {
    const auto leading = static_cast<Eigen::Index>(group.place.size());
    const Matrix r = triangle_of(dense_rows(rows, group));
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
