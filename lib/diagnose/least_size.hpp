// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/classify/episode_features.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/model/model.hpp"

/// A change that is found for sure may still be too small to act on. The size from which on a kind of fault
/// is reported is a share of what is usual for the joint or the robot (LeastSizes).
namespace faultline {

/// Returns the size of the fault by its likeliest hypothesis, and the least size; empty for kinds without a
/// size, and if no hypothesis has the label.
FaultExtent extent_of(const FaultLabel& label, const std::vector<LabelEvidence>& evidence,
                      const Model& model);

/// Returns the extent of a torque loss of `share` (0 to 1).
FaultExtent extent_of_torque_loss(double share, const Model& model);

/// Faults that are reported, and changes that are too small for it.
struct FaultsBySize {
  std::vector<FaultFinding> kept;   ///< in the order given
  std::vector<FaultFinding> small;  ///< by onset
};

/// Separates the faults that are too small from the others. Small ones of one label that reach the least size
/// together are kept: a slow change is found in several steps.
FaultsBySize faults_by_size(const std::vector<FaultFinding>& faults);

/// Describes a small change: kind, joint, onset, confidence, size, and the size from which on it is a fault.
std::string small_change_text(const FaultFinding& change, double sample_period_s);

/// States the size from which on each kind is a fault at each joint, in a sentence; empty if none has a size.
std::vector<std::string> least_size_sentences(const Model& model);

}  // namespace faultline
