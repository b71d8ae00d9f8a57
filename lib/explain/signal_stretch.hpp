// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/core/joint.hpp"
#include "lib/explain/decide_log.hpp"

namespace faultline {

/// Two signals of a log that contradict each other.
enum class SignalPair {
  drive,        ///< torque of the drive, and its command
  control_law,  ///< commanded torque, and what the controller computes from reference and motion
};

/// A stretch of a log in which two signals of a joint contradict each other. Their difference is a row of its
/// own beside those of the torque balance, and its noise is independent of theirs, so that log-likelihoods
/// add.
struct SignalStretch {
  SignalPair pair = SignalPair::drive;
  Joint joint{};
  std::size_t id = 0;    ///< chosen by the caller
  double onset_s = 0.0;  ///< first sample at which they differ
  double alarm_s = 0.0;  ///< earliest sample at which the difference passes its limit
  double end_s = kNeverEnds;
  double nats = 0.0;    ///< by which a difference of any form explains the signals better than none
  double limit = 0.0;   ///< nats that they had to exceed
  double offset = 0.0;  ///< mean of torque minus command, N m or N
  double loss = 0.0;    ///< share of the commanded torque that is missing, by least squares
  double loss_explains = 0.0, offset_explains = 0.0;  ///< shares of `nats` that they explain
  /// The torque balance uses the commanded torque; else the torque of the drive.
  bool balance_is_of_command = true;
};

/// The stretches that concern a part of a log.
struct SignalStretches {
  std::vector<FaultClaim> known{};     ///< faults of stretches that an earlier part has judged
  std::vector<SignalStretch> begin{};  ///< those that begin in this part, by onset
};

/// A stretch and the fault that explains it.
struct JudgedStretch {
  SignalStretch stretch;
  ExplainedFault fault;
  double in_balance = 0.0;  ///< part of its evidence by the torque balance; 0 if that shows nothing of it
};

/// Finds the fault that explains a stretch, by one score of the difference and the torque balance: a drive
/// that gives a share of its torque, a torque sensor that is wrong, or a fault of no kind. Without `fit` the
/// torque balance is not considered.
JudgedStretch judge_stretch(const SignalStretch& stretch, const LogFit* fit);

/// Returns the faults of stretches that the torque balance shows: further faults are judged beside them.
std::vector<FaultClaim> balance_claims(const std::vector<JudgedStretch>& stretches);

/// Judges stretches. `others` are the faults that the torque balance shows without them, `known` those of
/// earlier parts of the log. Leaves out the stretches that such a fault explains: those of control laws that
/// are the response to a fault, and those of drives that begin with a fault which explains more.
std::vector<JudgedStretch> judged_stretches(const std::vector<SignalStretch>& stretches,
                                            const std::vector<ExplainedFault>& others,
                                            std::vector<FaultClaim> known, const LogFit* fit);

/// Returns whether a stretch is the response of the controller to any fault of an earlier part of the log: a
/// control law that does not hold for long.
bool answers_earlier_fault(const SignalStretch& stretch);

}  // namespace faultline
