// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/classify/episode_features.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/model/model.hpp"

/// A change that is found for sure may still be too small to act on. From which size on a kind of fault is
/// reported is a share of what is usual for the joint or the robot (LeastSizes).
namespace faultline {

/// The size of the fault by its likeliest hypothesis, against the least one; empty for kinds without a size
/// and where no hypothesis bears the label.
FaultExtent extent_of(const FaultLabel& label, const std::vector<LabelEvidence>& evidence,
                      const Model& model);

/// A share of the torque that is lost.
FaultExtent extent_of_torque_loss(double share, const Model& model);

/// Takes those out of `faults` that are too small, and returns them by onset. Small ones of one label that
/// reach the least size together stay: what creeps away is found in several steps.
std::vector<FaultFinding> take_small_changes(std::vector<FaultFinding>& faults);

/// "changed payload at joint 3 from 4.2 s on: 0.0014 kg, below the least size of 0.05 kg".
std::string small_change_text(const FaultFinding& change, double sample_period_s);

/// From which size on each kind is a fault at each joint, in a sentence; empty where nothing has a size.
std::vector<std::string> least_size_sentences(const Model& model);

}  // namespace faultline
