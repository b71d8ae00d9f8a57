// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

namespace faultline {

/// What a confidence was computed from; each source has a systematic error of its own.
enum class ConfidenceSource { networks, votes, likelihood };
inline constexpr int kConfidenceSources = 3;

/// The confidence of a label for a fault whose true label is known.
struct JudgedConfidence {
  ConfidenceSource source = ConfidenceSource::networks;
  double said = 0.0;  ///< confidence before calibration, 0 to 1
  bool right = false;
};

/// Calibration of confidences: log odds of being right = slope x log odds of the confidence + shift (Platt,
/// "Probabilistic outputs for support vector machines", 1999). The default changes nothing.
struct ConfidenceCalibration {
  double slope = 1.0;
  std::array<double, kConfidenceSources> shift{};  ///< by source
  double most = 1.0;                               ///< largest confidence that so few runs support

  double of(ConfidenceSource source, double said) const;
};

/// Returns the maximum a posteriori calibration under a prior around the one that changes nothing.
ConfidenceCalibration calibrate_confidence(std::span<const JudgedConfidence> judged);

/// Expected calibration error: mean distance between confidence and relative frequency of being right, over
/// ten bins of the confidence. NaN if `judged` is empty.
double calibration_error(std::span<const JudgedConfidence> judged);

/// Expected calibration error after calibration; each half of `judged` is calibrated by the other half.
double held_out_calibration_error(std::span<const JudgedConfidence> judged);

}  // namespace faultline
