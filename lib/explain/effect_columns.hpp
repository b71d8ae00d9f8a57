// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/balance/noise.hpp"
#include "lib/explain/fault_columns.hpp"

namespace faultline {

/// Columns of the effects of a log. An effect reaches the rows of few joints: friction those of one, an
/// inertia those of its link's joint and the joints before it. Each joint keeps only the columns that reach
/// it, so that sums of products cost a fraction of those of the stacked columns.
class EffectColumns {
 public:
  EffectColumns() = default;
  /// `columns`: by joint, rows x effects.
  explicit EffectColumns(const std::vector<Eigen::MatrixXd>& columns);

  Eigen::Index effects() const { return effects_; }
  int joints() const { return static_cast<int>(column_.size()); }
  /// Returns the indices of the effects that reach the rows of a joint (from 0), ascending.
  const std::vector<int>& reach(int j) const { return reach_[j]; }
  /// Returns their columns, rows x reach.
  const Eigen::MatrixXd& column(int j) const { return column_[j]; }
  /// Returns all columns of a joint, rows x effects.
  Eigen::MatrixXd all(int j) const;

  /// Appends effects with these stacked columns.
  void append(const StackedColumns& columns);
  /// Returns the whitened columns; `white` by joint.
  EffectColumns whitened(const std::vector<Whitener>& white) const;

  /// Returns X' X of these columns X, or of their rows that `only` marks.
  Eigen::MatrixXd square() const;
  Eigen::MatrixXd square(const StackedMask& only) const;
  /// Returns X' C for stacked columns C.
  Eigen::MatrixXd along(const Eigen::Ref<const StackedColumns>& columns) const;
  /// Returns the same for columns that are 0 but in the rows from `begin` on; `torque` has these rows x
  /// joints.
  Eigen::VectorXd along(const Eigen::MatrixXd& torque, Eigen::Index begin) const;
  /// Returns the stacked torque X e.
  Stacked times(const Eigen::VectorXd& effects) const;

 private:
  Eigen::Index rows() const { return column_.empty() ? 0 : column_.front().rows(); }

  Eigen::Index effects_ = 0;
  std::vector<std::vector<int>> reach_;  ///< by joint
  std::vector<Eigen::MatrixXd> column_;  ///< by joint
};

}  // namespace faultline
