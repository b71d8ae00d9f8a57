// SPDX-License-Identifier: MIT
#pragma once

#include "lib/diagnose/decided_episode.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/diagnose/lasting_friction.hpp"
#include "lib/diagnose/sample_alarm.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// All that is said about an episode once the decision stands, but for similar cases (precedents_of()): what
/// it could also be, what speaks for it, and what to check next.
FaultFinding finding_of(const DecidedEpisode& decided, const Model& model);

/// Friction that is far beyond that of healthy days from the first row of a log on.
FaultFinding finding_of(const LastingFriction& fault, const Chain& chain);

/// What the paper's criterion found, with the other words of single networks as alternatives.
FaultFinding finding_of(const SampleAlarm& alarm);

}  // namespace faultline
