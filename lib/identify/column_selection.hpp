// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace faultline {

/// Columns of the weighted system that stand on their own, chosen by pivoted QR of the scaled columns.
struct ColumnSelection {
  std::vector<int> columns;       ///< in their order
  std::vector<bool> confounded;   ///< of all columns: left out, or nearly a mixture of others
  double condition_number = 0.0;  ///< of the chosen ones below `rigid`, scaled to length 1
};

/// Of the columns that `wanted` allows; the first `rigid` ones are those of the base parameters.
ColumnSelection select_columns(const Eigen::MatrixXd& a, const std::vector<bool>& wanted, int rigid);

}  // namespace faultline
