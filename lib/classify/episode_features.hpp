// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "lib/evidence/episode_evidence.hpp"
#include "lib/evidence/motion_model.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/residual/residual_summary.hpp"

namespace faultline {

/// What the bank makes of an episode by label: for each the best of its hypotheses.
struct LabelEvidence {
  FaultLabel label;
  double log_likelihood_ratio = 0.0;      ///< against healthy
  std::array<double, kMostSizes> size{};  ///< as the catalogue lists them, over their feature_scale()
  Surprise surprise{};                    ///< what it leaves unexplained
};

/// One entry a label of the bank, in a fixed order. A collision that pushes all joints counts for the joint
/// it pushes most, by the joint's usual torque.
std::vector<LabelEvidence> evidence_by_label(const EpisodeEvidence& episode, std::span<const Hypothesis> bank,
                                             const MotionModel& model);

/// Free-swinging and the loss of all torque are one fault: a loss of nearly all of it gets the former's name.
FaultLabel named_by_size(const FaultLabel& label, const std::vector<LabelEvidence>& evidence);

/// What the bank itself would say: the likeliest label, where a loss of nearly all torque is a free joint,
/// and an unknown disturbance is named only when every known fault explains less than half of what it
/// explains.
LabelEvidence likeliest(const std::vector<LabelEvidence>& evidence);

/// Posterior probability of `label` among all labels, each as likely as the others before the log was seen. A
/// loss of nearly all torque counts for the free joint.
double posterior_of(const FaultLabel& label, const std::vector<LabelEvidence>& evidence);

/// The numbers the two networks classify an episode by: for each label how far it stays behind the likeliest
/// and its size, how strong and how long the episode is, and the MLP's residual of each joint over the
/// episode (root mean square in units of healthy; a joint without one counts as 1).
std::vector<double> episode_features(const EpisodeEvidence& episode,
                                     const std::vector<LabelEvidence>& evidence,
                                     std::span<const JointResidual> residuals, int joints);
std::vector<std::string> episode_feature_names(std::span<const Hypothesis> bank, int joints);

}  // namespace faultline
