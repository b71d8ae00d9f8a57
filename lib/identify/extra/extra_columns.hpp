// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/identify/motion/stretch.hpp"
#include "lib/identify/parameter_space.hpp"

namespace faultline {

/// What the columns of extra terms are worked out with: what is known of the robot before they are fitted.
struct ExtraSetting {
  std::vector<int> shift;      ///< by joint: samples by which its torque acts later than logged; empty: 0
  double phi = 0.5;            ///< of the torque between samples
  Eigen::VectorXd parameters;  ///< of the space, whatever its extra terms; empty: those of its chain
};

/// What every sample of a stretch adds to the momentum balance, one column a sample: (joints x extra terms)
/// rows, term after term. Torques that the shift takes from beyond the stretch are those at its ends.
Eigen::MatrixXd extra_columns(const ParameterSpace& space, const Stretch& stretch,
                              const ExtraSetting& setting);

}  // namespace faultline
