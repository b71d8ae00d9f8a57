// SPDX-License-Identifier: MIT
#include "lib/identify/shooting/trailing_covariance.hpp"

#include <Eigen/SparseCore>
#include <suitesparse/SuiteSparseQR.hpp>

namespace faultline {
namespace {

using Index = SuiteSparse_long;
using ByColumns = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;
using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// J = Q R E' with R upper triangular and E a permutation.
class Factor {
 public:
  explicit Factor(ByColumns& j) {
    cholmod_l_start(&settings_);
    cholmod_sparse view{};
    view.nrow = static_cast<std::size_t>(j.rows());
    view.ncol = static_cast<std::size_t>(j.cols());
    view.nzmax = static_cast<std::size_t>(j.nonZeros());
    view.p = j.outerIndexPtr();
    view.i = j.innerIndexPtr();
    view.x = j.valuePtr();
    view.itype = CHOLMOD_LONG;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = view.packed = 1;
    const Index rank = SuiteSparseQR<double>(SPQR_ORDERING_BESTAMD, SPQR_DEFAULT_TOL, j.cols(), &view, &r_,
                                             &permutation_, &settings_);
    columns_ = j.cols();
    full_rank_ = r_ && rank == columns_;
  }
  ~Factor() {
    cholmod_l_free_sparse(&r_, &settings_);
    cholmod_l_free(static_cast<std::size_t>(columns_), sizeof(Index), permutation_, &settings_);
    cholmod_l_finish(&settings_);
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

  bool full_rank() const { return full_rank_; }

  /// R'^-1 E' of the unit vectors from `first` on.
  ByRows half(Index first) const {
    ByRows y = ByRows::Zero(columns_, columns_ - first);
    const auto* begin = static_cast<const Index*>(r_->p);
    const auto* rows = static_cast<const Index*>(r_->i);
    const auto* values = static_cast<const double*>(r_->x);
    for (Index k = 0; k < columns_; ++k) {
      const Index column = permutation_ ? permutation_[k] : k;
      if (column >= first) y(k, column - first) = 1.0;
      double diagonal = 0.0;
      for (Index p = begin[k]; p < begin[k + 1]; ++p) {
        if (rows[p] == k)
          diagonal = values[p];
        else
          y.row(k) -= values[p] * y.row(rows[p]);
      }
      y.row(k) /= diagonal;
    }
    return y;
  }

 private:
  cholmod_common settings_{};
  cholmod_sparse* r_ = nullptr;
  Index* permutation_ = nullptr;
  Index columns_ = 0;
  bool full_rank_ = false;
};

}  // namespace

bool trailing_covariance(const ceres::CRSMatrix& jacobian, int first, Eigen::MatrixXd& out) {
  const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> by_rows(
      jacobian.num_rows, jacobian.num_cols, static_cast<Eigen::Index>(jacobian.values.size()),
      jacobian.rows.data(), jacobian.cols.data(), jacobian.values.data());
  ByColumns columns = by_rows;
  const Factor factor(columns);
  if (!factor.full_rank()) return false;
  const ByRows half = factor.half(first);
  out = half.transpose() * half;
  return out.allFinite();
}

}  // namespace faultline
