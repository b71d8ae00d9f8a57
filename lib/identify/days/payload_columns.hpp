// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/identify/parameter_space.hpp"

namespace faultline {

/// What 1 kg at the end of each link adds to the base parameters: base parameters x links.
Eigen::MatrixXd payload_columns(const ParameterSpace& space);

}  // namespace faultline
