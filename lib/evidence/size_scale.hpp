// SPDX-License-Identifier: MIT
#pragma once

#include "lib/evidence/motion_model.hpp"
#include "lib/fault/fault_size.hpp"

namespace faultline {

/// The scale of the prior of a size of this measure at joint `j` (from 0), SI units; an impulse has none of
/// its own and takes that of the torque.
double prior_scale(const SizePriors& priors, SizeMeasure measure, int j);
/// What a size is divided by to become a feature of an episode: its prior's scale, for an impulse that of a
/// usual push.
double feature_scale(const MotionModel& model, SizeMeasure measure, int j);

/// What the measure is a share of where shares are drawn or told (usual_of() in words): the range of the
/// joint, its usual friction, the mass carried, its largest torque; 1 for a share of torque.
double usual_size(const MotionModel& model, SizeMeasure measure, int j);

}  // namespace faultline
