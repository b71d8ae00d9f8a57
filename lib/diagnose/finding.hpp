// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/diagnose/decision.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/diagnose/monitor/monitored_log.hpp"
#include "lib/explain/day_effects.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Friction so far beyond that of healthy days that it is a fault rather than an effect of the day, in a log
/// that shows no onset of it.
struct LastingFriction {
  DayEffect effect;
  double start_s = 0.0, end_s = 0.0;  ///< of the log
};

/// Returns the frictions of a log's day whose whole 95 % interval lies above twice the normal range.
std::vector<LastingFriction> lasting_friction(const std::vector<DayEffect>& day, double start_s,
                                              double end_s);

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
