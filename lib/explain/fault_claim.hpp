// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>

#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// End of a fault that lasts to the end of the log, s.
inline constexpr double kNeverEnds = std::numeric_limits<double>::infinity();

/// What is said of a log: a fault of a kind at a joint, from when to when, and how large.
struct FaultClaim {
  FaultKind kind = FaultKind::none;
  int joint = 0;  ///< from 1
  double onset_s = 0.0;
  double end_s = kNeverEnds;
  /// Share of the torque lost; viscous and Coulomb friction added; kg at the end of the link; force on each
  /// joint; torque that is logged beside the one that acts (N m or N); false position (rad or m) or drift
  /// (rad/s or m/s). Empty for kinds without a size, and where it is not known.
  Eigen::VectorXd size{};
  /// From nothing at the onset; then `size` is that of each second, as friction that creeps.
  bool grows = false;
  /// Of a false position: the velocity is measured apart from it and shows nothing of it. A velocity that is
  /// computed from the position drifts with it, and is wrong for a moment where it jumps.
  bool velocity_is_true = false;

  FaultLabel label() const { return {kind, joint}; }
};

/// Whether a fault makes a position read wrong and moves nothing.
inline bool reads_wrong(FaultKind kind) {
  return kind == FaultKind::sensor_bias || kind == FaultKind::sensor_drift;
}

/// Whether the torque balance of the joint says nothing while the fault lasts.
inline bool silences(FaultKind kind) {
  return kind == FaultKind::locked || kind == FaultKind::stuck_encoder || kind == FaultKind::unknown;
}

/// A free joint is one that loses its whole torque.
inline FaultKind column_kind(FaultKind kind) {
  return kind == FaultKind::free_swinging ? FaultKind::torque_loss : kind;
}

}  // namespace faultline
