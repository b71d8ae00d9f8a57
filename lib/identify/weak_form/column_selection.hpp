// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace faultline {

/// Independent columns of the weighted system, chosen by pivoted QR of the scaled columns.
struct ColumnSelection {
  std::vector<int> columns;       ///< in their order
  std::vector<bool> confounded;   ///< of all columns: excluded, or with a part in an excluded column
  double condition_number = 0.0;  ///< of the chosen columns below `rigid`, scaled to length 1
};

/// Selects from the columns that `wanted` allows; the first `rigid` ones are those of the base parameters.
ColumnSelection select_columns(const Eigen::MatrixXd& a, const std::vector<bool>& wanted, int rigid);

}  // namespace faultline
