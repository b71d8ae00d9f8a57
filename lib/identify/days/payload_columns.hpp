// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/identify/parameter_space.hpp"

namespace faultline {

/// Returns the change of the base parameters by 1 kg at the end of each link: base parameters x links.
Eigen::MatrixXd payload_columns(const ParameterSpace& space);

}  // namespace faultline
