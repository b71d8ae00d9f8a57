// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

namespace faultline {

/// What a number measures that says how large a fault is.
enum class SizeMeasure {
  torque_share,      ///< 1, of the drive's torque
  length,            ///< rad or m
  length_per_s,      ///< rad/s or m/s
  viscous_friction,  ///< N m s/rad or N s/m
  coulomb_friction,  ///< N m or N
  mass,              ///< kg
  torque,            ///< N m or N
  impulse,           ///< N m s or N s
};

/// The unit at a joint that turns, or at one that slides.
const char* unit_of(SizeMeasure measure, bool turns);

/// What is usual for the joint (or the robot), which the twin takes shares of: in words, such as "the range".
const char* usual_of(SizeMeasure measure);

enum class Spread { uniform, log_uniform };
const char* to_string(Spread spread);

/// A range to draw from.
struct DrawRange {
  double low = 0.0;
  double high = 0.0;
  Spread spread = Spread::uniform;
  bool either_sign = false;  ///< as often negative as positive

  bool operator==(const DrawRange&) const = default;
};

/// One size of a kind of fault.
struct FaultSize {
  SizeMeasure measure = SizeMeasure::torque;
  /// What stands for this size among the features of an episode: the same, or the impulse of a torque that
  /// passes.
  SizeMeasure feature = measure;
  const char* feature_name = "size";  ///< before the label in the feature's name
  DrawRange twin{};  ///< what a technician would call a fault, as a share of usual_of(measure)
};

}  // namespace faultline
