// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

namespace faultline {

/// Physical quantity of the size of a fault.
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

/// Returns the unit at a joint that turns, or at one that slides.
const char* unit_of(SizeMeasure measure, bool turns);

/// Returns, in words such as "the range", the usual value of the measure, of which the twin draws a share.
const char* usual_of(SizeMeasure measure);

enum class Spread { uniform, log_uniform };
const char* to_string(Spread spread);

/// A range of random values.
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
  /// Quantity that represents this size among the features of an episode: the same one, or the impulse of a
  /// torque that passes.
  SizeMeasure feature = measure;
  const char* feature_name = "size";  ///< before the label in the feature's name
  DrawRange twin{};  ///< range that a technician would call a fault, as a share of usual_of(measure)
};

}  // namespace faultline
