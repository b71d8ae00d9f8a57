// SPDX-License-Identifier: MIT
#pragma once

#include "lib/diagnose/decision.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/diagnose/lasting_friction.hpp"
#include "lib/diagnose/monitored_episode.hpp"
#include "lib/diagnose/sample_alarm.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// An episode with its decision, from which a finding is made. What it refers to outlives it.
struct DecidedEpisode {
  const MonitoredEpisode& observed;
  const DecisionBasis& basis;
  Decision decision;
};

/// Makes the finding of a decided episode, without similar cases (precedents_of()): label, times and size,
/// alternatives, evidence, and what to check next.
FaultFinding finding_of(const DecidedEpisode& decided, const Model& model);

/// Makes the finding of a friction that is far beyond that of healthy days from the first row of a log on.
FaultFinding finding_of(const LastingFriction& fault, const Chain& chain);

/// Makes the finding of an alarm of the paper's criterion; other labels of single networks are alternatives.
FaultFinding finding_of(const SampleAlarm& alarm);

}  // namespace faultline
