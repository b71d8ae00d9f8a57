// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/fault/fault_catalogue.hpp"

namespace faultline {

/// Returns the possible faults of a robot of so many joints: each kind at each joint it can have, in the
/// order of the catalogue, without the unknown fault. `payload_links`: links (from 0) whose payload is
/// identifiable. `torque_is_measured`: behind the drive, which hides some kinds.
std::vector<FaultLabel> fault_labels(int joints, const std::vector<int>& payload_links,
                                     bool torque_is_measured);

}  // namespace faultline
