// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// What a log cannot show, a sentence each, by what its torque means and whether it has velocities.
std::vector<std::string> blind_spots(TorqueMeaning torque, bool has_velocity);

/// The stretches in which a joint could not be judged for longer than a moment, a sentence each, and one for
/// those beyond the first few.
/// What joints that hardly moved cannot show.
std::vector<std::string> resting_spots(const LogFacts& log);
std::vector<std::string> unjudged_spots(const LogFacts& log);
/// "joint 2 could not be judged from 1.200 s to 9.990 s, the end of the log: its torque is missing".
std::string unjudged_words(const UnjudgedStretch& stretch, const LogFacts& log);

/// Second residuals of the model that a log lacks the signals for, a sentence each; `judged_s` by relation.
std::vector<std::string> relation_spots(const std::vector<SignalRelation>& relations,
                                        const std::vector<double>& judged_s);

/// Drives that were asked for more than in the healthy logs, which does not show what they can give then; a
/// sentence each. `beyond_s` by relation: for how long.
std::vector<std::string> drive_limit_spots(const std::vector<SignalRelation>& relations,
                                           const std::vector<double>& beyond_s, const Chain& chain);

/// Share of the simulated faults that a model found; NaN where none were simulated.
double power_of(const Validation& validation);

/// The kinds of which it found too few, a sentence each.
std::vector<std::string> weak_spots(const Validation& validation);

/// How much less is seen where the model misses more torque than in the learned logs (Diagnosis::roughness):
/// a sentence, or none.
std::vector<std::string> rough_spots(const std::vector<double>& roughness);

/// How small a fault is surely found, a sentence for each kind that has a size.
std::vector<std::string> reach_sentences(const std::vector<Reach>& reach, const Chain& chain);

/// The size from which on a fault is surely found, such as "22 %" or "0.004 rad"; "not surely" where none is
/// large enough, "" for kinds without a size.
std::string reach_text(const Reach& reach, const Chain& chain);

}  // namespace faultline
