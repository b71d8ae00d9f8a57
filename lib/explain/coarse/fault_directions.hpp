// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/balance/one_step/one_step_model.hpp"
#include "lib/core/joint.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// Directions of a kind's sizes in the numbers of the law of motion, with the prior standard deviation of the
/// sizes. Sizes: share of the torque lost; viscous and Coulomb friction added; kg at the end of the link;
/// force on each joint; offset of the logged torque; empty for kinds that change no number.
struct FaultDirections {
  Eigen::MatrixXd direction;  ///< numbers x sizes
  Eigen::VectorXd std;
};

FaultDirections fault_directions(const OneStepModel& model, FaultKind kind, Joint joint);
/// Returns the kinds and joints of the faults that are judged.
std::vector<FaultLabel> fault_labels_of(const OneStepModel& model);
/// Returns the prior standard deviation of the sizes of a fault, also of a false position (rad or m) and of a
/// drift (rad/s or m/s).
Eigen::VectorXd prior_of_sizes(const OneStepModel& model, FaultKind kind, Joint joint);

}  // namespace faultline
