// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// Returns kind and joint for tables and messages: "torque_loss 2", or with " at joint " between them; the
/// kind alone if the fault belongs to no joint.
std::string label_text(const FaultLabel& label, const char* between = " ");

}  // namespace faultline
