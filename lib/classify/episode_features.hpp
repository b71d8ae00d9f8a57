// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/explain/decide_log.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/identify/usual_motion.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {

/// Evidence of the regression for one label in an episode.
struct LabelEvidence {
  FaultLabel label;
  double log_likelihood_ratio = 0.0;      ///< against healthy, nats; -1000 if the label was not judged
  std::array<double, kMostSizes> size{};  ///< in the order of the catalogue, divided by feature_scale()
  double left = std::numeric_limits<double>::quiet_NaN();  ///< mean square of its residual; 1 is noise
};

/// Returns one entry for each label, in the order of `labels`. `end_s` is the last sample of the episode, at
/// which the size of a growing fault is taken.
std::vector<LabelEvidence> evidence_by_label(const ExplainedFault& fault, double end_s,
                                             std::span<const FaultLabel> labels, const UsualMotion& usual);

/// Returns the sizes of a fault in the units of the catalogue's features; of a growing fault, at `end_s`.
std::array<double, kMostSizes> sizes_of(const FaultClaim& claim, double end_s, int joints);

/// Momentum that a collision of the scored size transfers to joint `j` (from 0), N m s or N s.
double impulse_of(const FaultClaim& collision, int j, int joints);

/// Returns the posterior probability of `label` among all labels, with equal priors.
double posterior_of(const FaultLabel& label, const std::vector<LabelEvidence>& evidence);

/// Returns the inputs of the two networks: for each label its deficit of evidence to the most likely one and
/// its size, the strength and the duration of the episode, and the MLP's residual of each joint over the
/// episode (rms in units of healthy rms; a joint without one counts as 1).
std::vector<double> episode_features(const std::vector<LabelEvidence>& evidence, double lasts_s,
                                     std::span<const JointResidual> residuals, int joints);

enum class FeatureRole {
  behind,    ///< deficit of evidence of `label` to the most likely label
  size,      ///< size number `size` of `label`, in the order of its kind
  strength,  ///< evidence of the most likely label against healthy
  duration,  ///< time from onset to end
  residual,  ///< residual of the MLP at `joint`
};
struct EpisodeFeature {
  FeatureRole role = FeatureRole::strength;
  FaultLabel label{};
  int size = 0;  ///< from 0
  Joint joint{};
};

/// Returns the meaning of each feature in the order of episode_features().
std::vector<EpisodeFeature> episode_feature_list(std::span<const FaultLabel> labels, int joints);
std::string name_of(const EpisodeFeature& feature);
std::vector<std::string> episode_feature_names(std::span<const FaultLabel> labels, int joints);

/// A feature of an episode for a person: in words, and in a unit instead of its logarithm.
struct DescribedFeature {
  std::string what;                                         ///< such as "MLP residual of joint 2"
  std::string unit;                                         ///< empty for a number without unit
  double value = std::numeric_limits<double>::quiet_NaN();  ///< NaN if the feature does not determine it
};

/// Returns feature `which` of `features`, whose meaning is `list`. The size of a label far less likely than
/// the best one is NaN.
DescribedFeature describe_feature(std::span<const EpisodeFeature> list, std::size_t which,
                                  std::span<const double> features, const UsualMotion& usual,
                                  const Chain& chain);

}  // namespace faultline
