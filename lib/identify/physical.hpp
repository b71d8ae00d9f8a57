// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/identify/identification.hpp"

namespace faultline {

/// Masses and lengths of the links, as far as base parameters and the robot file's facts determine them.
struct PhysicalFit {
  std::vector<ParameterEstimate> parameters;  ///< m1.., then l1..; NaN where not identifiable
  /// Lengths of all links when every one is known or identified.
  std::optional<std::vector<double>> lengths;
};

/// Solves the base parameters (weighted by their covariance) and the facts in robot.known for the masses and
/// lengths of rods and points. What stays open names the facts that would close it. `usable` marks the base
/// parameters that the logs determine.
PhysicalFit physical_parameters(const Robot& robot, const ParameterSpace& space,
                                const Eigen::VectorXd& estimate, const Eigen::MatrixXd& covariance,
                                const std::vector<bool>& usable);

}  // namespace faultline
