// SPDX-License-Identifier: MIT
#pragma once

#include "lib/identify/gathered.hpp"
#include "lib/identify/shooting_stage.hpp"
#include "lib/identify/weak_form/weak_choice.hpp"

namespace faultline {

/// Least share of a joint's torque that a valid model explains.
inline constexpr double kExplained = 0.5;

/// Judges how well `id.estimate` explains the torque, and fills `id`: fit by joint, by log and held out, gain
/// by each term, torque delays, patterns of the residual and trends from log to log. A joint below kExplained
/// makes the status `unexplained`, one explained in part `poorly_explained`. Joints that never move (`still`,
/// from 1) are not judged; those with almost no torque (`undriven`) cannot be `poorly_explained`.
void judge_fit(const TorqueFit& torque, const ModelChoice& choice, const Gathered& gathered,
               const std::vector<int>& still, const std::vector<int>& undriven, Identification& id);

}  // namespace faultline
