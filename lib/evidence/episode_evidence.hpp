// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "lib/evidence/evidence_trace.hpp"
#include "lib/evidence/hypothesis.hpp"
#include "lib/evidence/surprise.hpp"

namespace faultline {

/// What one hypothesis explains of an episode.
struct HypothesisEvidence {
  double log_likelihood_ratio = -std::numeric_limits<double>::infinity();  ///< against healthy, best onset
  double onset_s = std::numeric_limits<double>::quiet_NaN();               ///< that best onset
  std::array<double, 2> size{};  ///< estimated, as many as the hypothesis has (SizePriors gives units)
  std::array<double, 2> size_std{};
  std::array<double, kMaxJoints> impulse{};  ///< of a collision, a joint each, N m s or N s
  Surprise surprise{};                       ///< what it leaves unexplained
};

/// A joint that stands still at the end of an episode, within its healthy range, and what acts on it there;
/// all 0 for a joint that moves, or that stands where an end stop may hold it. A joint that no torque reaches
/// comes to rest by friction and weight alone, and rests only where friction holds its weight.
struct Standstill {
  double lasts_s = 0.0;
  double drive = 0.0;   ///< mean logged torque beyond what weight asks, over the joint's Coulomb friction
  double weight = 0.0;  ///< mean torque of gravity over the same; 0 where the joint sank since the onset
  double braked = 0.0;  ///< motion energy at the onset over what friction and weight take until it stands
};

/// A stretch of a log that the healthy robot does not explain, and what each hypothesis of the bank makes of
/// it.
struct EpisodeEvidence {
  double onset_s = std::numeric_limits<double>::quiet_NaN();  ///< of the best hypothesis
  double alarm_s =
      std::numeric_limits<double>::quiet_NaN();  ///< first sample with the best ratio past the threshold
  double isolated_s = std::numeric_limits<double>::quiet_NaN();  ///< last sample that went into the ratios
  double end_s = std::numeric_limits<double>::quiet_NaN();       ///< last sample that looked faulty
  int samples = 0;                                               ///< from onset to isolated_s
  int best = -1;                                                 ///< index into `hypotheses`
  std::vector<HypothesisEvidence> hypotheses;                    ///< in the order of the bank
  Surprise usual{};  ///< of the filter without this fault, a while before the onset
  EvidenceTrace trace;
  std::array<Standstill, kMaxJoints> standstill{};  ///< of each joint
};

}  // namespace faultline
