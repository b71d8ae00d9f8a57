// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "lib/explain/decide_log.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/identify/usual_motion.hpp"
#include "lib/residual/residual_summary.hpp"

namespace faultline {

/// What the regression makes of one label in an episode.
struct LabelEvidence {
  FaultLabel label;
  double log_likelihood_ratio = 0.0;      ///< against healthy; far below 0 where it was not worth judging
  std::array<double, kMostSizes> size{};  ///< as the catalogue lists them, over their feature_scale()
  double left = std::numeric_limits<double>::quiet_NaN();  ///< mean square that it leaves; 1 is noise
};

/// One entry a label, in the order of `labels`. `end_s` is the last sample of the episode, up to which a
/// fault that grows has grown.
std::vector<LabelEvidence> evidence_by_label(const ExplainedFault& fault, double end_s,
                                             std::span<const FaultLabel> labels, const UsualMotion& usual);

/// Sizes of a fault in the units of the catalogue's features, as far as it has grown by `end_s`.
std::array<double, kMostSizes> sizes_of(const FaultClaim& claim, double end_s, int joints);

/// Momentum that a collision of the scored size passes on to joint `joint` (from 0), N m s or N s.
double impulse_of(const FaultClaim& collision, int joint, int joints);

/// Posterior probability of `label` among all labels, each as likely as the others before the log was seen.
double posterior_of(const FaultLabel& label, const std::vector<LabelEvidence>& evidence);

/// The numbers the two networks classify an episode by: for each label how far it stays behind the likeliest
/// and its size, how strong and how long the episode is, and the MLP's residual of each joint over the
/// episode (root mean square in units of healthy; a joint without one counts as 1).
std::vector<double> episode_features(const std::vector<LabelEvidence>& evidence, double lasts_s,
                                     std::span<const JointResidual> residuals, int joints);

/// What a number among the features of an episode tells.
enum class FeatureRole {
  behind,    ///< how far `label` stays behind the likeliest
  size,      ///< size number `size` of `label`, as its kind has them
  strength,  ///< how much likelier the best label is than a healthy robot
  duration,  ///< from onset to end
  residual,  ///< of the MLP at `joint`
};
struct EpisodeFeature {
  FeatureRole role = FeatureRole::strength;
  FaultLabel label{};
  int size = 0;   ///< from 0
  int joint = 0;  ///< from 1
};

/// What episode_features() gives, in its order.
std::vector<EpisodeFeature> episode_feature_list(std::span<const FaultLabel> labels, int joints);
std::string name_of(const EpisodeFeature& feature);
std::vector<std::string> episode_feature_names(std::span<const FaultLabel> labels, int joints);

// How numbers become features, and back as far as that is possible: nats behind the likeliest (at most
// kLargestDeficit), and how much the size of a label so far behind counts.
inline constexpr double kLargestDeficit = 300.0;  ///< beyond it a label is out of the question anyway
double feature_of_deficit(double nats);
double deficit_of_feature(double feature);
double size_counts(double deficit_nats);

}  // namespace faultline
