// SPDX-License-Identifier: MIT
#pragma once

#include "lib/classify/confidence_calibration.hpp"

namespace faultline {

/// What decided on the label of a fault.
enum class DecidedBy {
  agreement,    ///< both networks
  cases,        ///< similar cases and the networks' opinions, by vote
  evidence,     ///< the likelihood of the physical hypotheses
  criterion,    ///< the fault criterion over single samples
  actuator,     ///< the second residual of measured against commanded torque
  control_law,  ///< that of commanded torque against the inputs of the controller
  tracking,     ///< that of the motion against its reference
  abstained,    ///< nothing: networks too unsure, or votes too even, to name a fault
};
const char* to_string(DecidedBy decided_by);

/// Returns what the confidence of a decision on an episode comes from.
ConfidenceSource confidence_source(DecidedBy decided_by);

}  // namespace faultline
