// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/decide_log.hpp"

namespace faultline {

/// Two signals of a log that contradict each other.
enum class SignalPair {
  drive,        ///< the torque that the drive gave, and the torque that it was asked for
  control_law,  ///< the torque that was asked for, and what the controller makes of reference and motion
};

/// A stretch of a log in which two signals of a joint contradict each other. Their difference is a row of its
/// own beside those of the torque balance, and its noise is independent of theirs, so that log-likelihoods
/// add.
struct SignalStretch {
  SignalPair pair = SignalPair::drive;
  int joint = 0;         ///< from 1
  std::size_t id = 0;    ///< of whoever asks
  double onset_s = 0.0;  ///< first sample that differs
  double alarm_s = 0.0;  ///< earliest sample at which the difference passes its limit
  double end_s = kNeverEnds;
  double nats = 0.0;   ///< by which a difference of any form explains the signals better than none
  double limit = 0.0;  ///< nats that it had to pass
  double loss = 0.0;   ///< share of the asked torque that is missing, by least squares
  double loss_explains = 0.0, offset_explains = 0.0;  ///< of `nats`, what that loss or an offset explains
  /// The torque balance is written with the torque that was asked for; else with the one that the drive gave.
  bool balance_is_of_command = true;
};

/// The stretches that concern a part of a log.
struct SignalStretches {
  std::vector<FaultClaim> known{};     ///< that an earlier part has judged
  std::vector<SignalStretch> begin{};  ///< that begin in this part, by onset
};

/// The fault that explains a stretch, by one score of the difference and the torque balance: a drive that
/// gives a share of its torque, a torque sensor that is off, or a fault of no kind. Without `fit` the torque
/// balance says nothing.
ExplainedFault judge_stretch(const SignalStretch& stretch, const LogFit* fit);

/// A stretch and the fault that explains it.
struct JudgedStretch {
  SignalStretch stretch;
  ExplainedFault fault;
};

/// The faults of the torque balance beside which a further fault is to be judged: none for a loss that the
/// torque balance does not show.
std::vector<FaultClaim> balance_claims(const std::vector<JudgedStretch>& stretches);

/// The faults of all drives.
std::vector<JudgedStretch> judged_drives(const std::vector<SignalStretch>& stretches, const LogFit* fit);

/// The same with those of control laws, but for laws that are left because the controller answers to a fault
/// among `others` or these.
std::vector<JudgedStretch> with_laws(std::vector<JudgedStretch> drives,
                                     const std::vector<SignalStretch>& stretches,
                                     const std::vector<FaultClaim>& others, const LogFit* fit);

/// Whether a fault begins while a control law is left.
bool begins_within_law(const std::vector<JudgedStretch>& stretches, const FaultClaim& fault);

/// Whether a stretch is how the controller answers to any fault that an earlier part of the log held: a
/// control law that is left for long.
bool answers_earlier_fault(const SignalStretch& stretch);

}  // namespace faultline
