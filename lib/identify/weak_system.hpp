// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/identify/weak_form.hpp"

namespace faultline {

/// All windows as one system, row (window, joint).
struct WeakSystem {
  Eigen::MatrixXd a;
  Eigen::VectorXd y;
  Eigen::VectorXd use;     ///< 1, or 0 for rows to leave out
  std::vector<int> block;  ///< of each row: windows of the same second of the same log
  int joints = 0;
};

/// The known width nearest to that of `parameters`.
int nearest_width(const ParameterSpace& space, const Eigen::VectorXd& parameters, int joint);

/// The system at the friction widths nearest to those of `parameters`.
WeakSystem assemble(const WeakWindows& windows, const Eigen::VectorXd& parameters);

}  // namespace faultline
