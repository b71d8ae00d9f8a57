// SPDX-License-Identifier: MIT
#pragma once

#include "lib/classify/confidence_calibration.hpp"

namespace faultline {

/// Who settled what a fault is.
enum class DecidedBy {
  agreement,    ///< both networks
  cases,        ///< similar cases and the networks' opinions, by vote
  evidence,     ///< the likelihood of the physical hypotheses
  criterion,    ///< the fault criterion over single samples
  actuator,     ///< the second residual of measured against commanded torque
  control_law,  ///< that of commanded torque against what the controller reads
  tracking,     ///< that of the motion against its reference
  abstained,    ///< nobody: too thin or too even to name a fault
};
const char* to_string(DecidedBy decided_by);

/// What the confidence of a decision on an episode was worked out from.
ConfidenceSource confidence_source(DecidedBy decided_by);

}  // namespace faultline
