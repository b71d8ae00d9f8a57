// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <numbers>

#include "lib/core/joint.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// End of a fault that lasts to the end of the log, s.
inline constexpr double kNeverEnds = std::numeric_limits<double>::infinity();

/// Means over time of the forms that the force of a collision has: constant, and sines of one, two and three
/// half waves from its onset to its end. Its sizes are those of the first form on each joint, then of the
/// second, ..
inline constexpr std::array<double, 4> kMeanOfForceForm = {1.0, 2.0 * std::numbers::inv_pi, 0.0,
                                                           2.0 / 3.0 * std::numbers::inv_pi};

/// Time in which a fault is present.
struct FaultSpan {
  double onset_s = 0.0, end_s = kNeverEnds;

  bool operator==(const FaultSpan&) const = default;
};

/// A claim on a log: a fault of a kind at a joint, with onset, end and size.
struct FaultClaim {
  FaultKind kind = FaultKind::none;
  Joint joint{};
  double onset_s = 0.0;
  double end_s = kNeverEnds;
  /// Share of the torque lost; viscous and Coulomb friction added; kg at the end of the link; force on each
  /// joint; offset of the logged torque (N m or N); false position (rad or m) or drift (rad/s or m/s). Empty
  /// for kinds without a size, and if it is unknown.
  Eigen::VectorXd size{};
  /// Grows from zero at the onset, such as friction that creeps; then `size` is the growth in each second.
  bool grows = false;
  /// For a false position: the velocity is measured independently and is true. A velocity that is computed
  /// from the position drifts with it, and is wrong for a moment when it jumps.
  bool velocity_is_true = false;
  /// For an unknown fault: another torque of this joint's drive, so that the rows of the other joints hold.
  bool is_of_drive = false;
  /// For a collision: its force may have all forms of kMeanOfForceForm, not the first two alone.
  bool has_any_form = false;

  FaultLabel label() const { return {kind, joint}; }
};

/// Returns whether a fault falsifies the measured position and does not change the motion.
inline bool falsifies_position(FaultKind kind) {
  return kind == FaultKind::sensor_bias || kind == FaultKind::sensor_drift;
}

/// Returns whether the rows of the joint are silent while the fault lasts.
inline bool silences(FaultKind kind) {
  return kind == FaultKind::locked || kind == FaultKind::stuck_encoder || kind == FaultKind::unknown;
}

/// Returns whether the torque balance of every joint is silent while the fault lasts.
inline bool silences_all(const FaultClaim& claim) {
  return claim.kind == FaultKind::unknown && !claim.is_of_drive;
}

/// Returns the kind whose columns describe a kind: a free joint loses its whole torque.
inline FaultKind column_kind(FaultKind kind) {
  return kind == FaultKind::free_swinging ? FaultKind::torque_loss : kind;
}

}  // namespace faultline
