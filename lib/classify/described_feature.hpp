// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <span>
#include <string>

#include "lib/classify/episode_features.hpp"

namespace faultline {

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
