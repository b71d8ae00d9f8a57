// SPDX-License-Identifier: MIT
#pragma once

#include "lib/identify/gathered.hpp"
#include "lib/identify/shooting_stage.hpp"
#include "lib/identify/weak_form/weak_choice.hpp"

namespace faultline {

/// Share of a joint's torque that a model must explain to be one of it.
inline constexpr double kExplained = 0.5;

/// Fills in how well `id.estimate` explains the torque: by joint, by log and held out, what each term was
/// worth, how late each torque acts, what is left of it and how it changes from log to log. A joint that is
/// hardly explained makes the status `unexplained`, one explained in part `poorly_explained`. Joints that
/// never move (`still`, from 1) are not judged, those with next to no torque (`undriven`) not by their part.
void judge_fit(const TorqueFit& torque, const ModelChoice& choice, const Gathered& gathered,
               const std::vector<int>& still, const std::vector<int>& undriven, Identification& id);

}  // namespace faultline
