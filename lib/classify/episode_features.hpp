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

/// What a number among the features of an episode tells.
enum class FeatureRole {
  behind,    ///< how far `label` stays behind the likeliest
  size,      ///< size number `size` of `label`, as its kind has them
  strength,  ///< how much likelier the best label is than a healthy robot
  samples,   ///< from onset to name
  duration,  ///< the same as time
  residual,  ///< of the MLP at `joint`
};
struct EpisodeFeature {
  FeatureRole role = FeatureRole::strength;
  FaultLabel label{};
  int size = 0;   ///< from 0
  int joint = 0;  ///< from 1
};

/// What episode_features() gives, in its order.
std::vector<EpisodeFeature> episode_feature_list(std::span<const Hypothesis> bank, int joints);
std::string name_of(const EpisodeFeature& feature);
std::vector<std::string> episode_feature_names(std::span<const Hypothesis> bank, int joints);

// How numbers become features, and back as far as that is possible: nats behind the likeliest (at most
// kLargestDeficit), and how much the size of a label so far behind counts.
inline constexpr double kLargestDeficit = 300.0;  ///< beyond it a label is out of the question anyway
double feature_of_deficit(double nats);
double deficit_of_feature(double feature);
double size_counts(double deficit_nats);

}  // namespace faultline
