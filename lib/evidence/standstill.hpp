// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lib/evidence/episode_evidence.hpp"
#include "lib/evidence/filter/history.hpp"
#include "lib/evidence/motion_model.hpp"

namespace faultline {

/// Of joint `joint` (from 0) in an episode from sample `onset` to sample `now`.
Standstill standstill_of(const MotionModel& model, const History& history, int joint, std::int64_t onset,
                         std::int64_t now);

/// Whether something holds the joint. `torque_flows`: the logged torque is known to have acted, as one that
/// was measured is and one that was commanded is not.
bool is_held(const Standstill& joint, bool torque_flows);

}  // namespace faultline
