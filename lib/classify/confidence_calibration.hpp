// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

namespace faultline {

/// What a confidence was worked out from; each errs in its own way.
enum class ConfidenceSource { networks, votes, likelihood };
inline constexpr int kConfidenceSources = 3;

/// A name that was given to a fault whose name is known.
struct JudgedConfidence {
  ConfidenceSource source = ConfidenceSource::networks;
  double said = 0.0;  ///< 0 to 1
  bool right = false;
};

/// How often a confidence is right: log odds of being right = slope x log odds of what was said + shift
/// (Platt, "Probabilistic outputs for support vector machines", 1999). As it stands here it changes nothing.
struct ConfidenceCalibration {
  double slope = 1.0;
  std::array<double, kConfidenceSources> shift{};  ///< by source
  double most = 1.0;                               ///< more cannot be claimed from so few runs

  double of(ConfidenceSource source, double said) const;
};

/// The likeliest calibration under a prior around the one that changes nothing.
ConfidenceCalibration calibrate_confidence(std::span<const JudgedConfidence> judged);

/// Expected calibration error: mean distance between what was said and how often it was right, over ten bins
/// of what was said. NaN for none.
double calibration_error(std::span<const JudgedConfidence> judged);

/// The same of calibrated confidences, each half of `judged` calibrated by the other.
double held_out_calibration_error(std::span<const JudgedConfidence> judged);

}  // namespace faultline
