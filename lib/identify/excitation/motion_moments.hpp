// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/identify/excitation/excitation.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/simulate/motion.hpp"

namespace faultline {

/// `Excitation::moments` as they would be if the logs were `duration_s` of that reference, in the columns and
/// scales of `of`.
Eigen::MatrixXd motion_moments(const ParameterSpace& space, const Excitation& of, const Motion& reference,
                               double duration_s);

/// Condition number of a motion's regressor, each column counted in its `unit`, so that a column that is
/// hardly shown counts as badly as one that is hardly told from the others; infinite when one is not told at
/// all.
double condition_of(const Eigen::MatrixXd& moments, const Eigen::VectorXd& unit);

}  // namespace faultline
