// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/diagnose/decision.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/diagnose/monitor/monitored_log.hpp"
#include "lib/explain/day/day_effects.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Returns the frictions of a log's day that are so far beyond those of healthy days that they are faults:
/// their whole 95 % interval lies above twice the normal range.
std::vector<DayEffect> lasting_friction(const std::vector<DayEffect>& day);

/// An episode with its decision, from which a finding is made. What it refers to outlives it.
struct DecidedEpisode {
  const MonitoredEpisode& observed;
  const DecisionBasis& basis;
  Decision decision;
};

/// Makes the finding of a decided episode, without similar cases (precedents_of()): label, times and size,
/// alternatives, evidence, and what to check next.
FaultFinding finding_of(const DecidedEpisode& decided, const Model& model);

/// Makes the finding of a lasting_friction(), which begins with the first row of the log.
FaultFinding finding_of(const DayEffect& friction, const LogFacts& log, const Chain& chain);

/// Makes the finding of an alarm of the paper's criterion; other labels of single networks are alternatives.
FaultFinding finding_of(const SampleAlarm& alarm);

}  // namespace faultline
