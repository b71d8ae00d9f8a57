// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Lists what a log cannot show, a sentence each, by the meaning of its torque and whether it has velocities.
std::vector<std::string> blind_spots(TorqueMeaning torque, bool has_velocity);

/// Lists the joints that hardly moved, so that some faults cannot be seen there, a sentence each.
std::vector<std::string> resting_spots(const LogFacts& log);
/// Lists the joints of which torques are at the limit of the drive, a sentence each; these rows show nothing.
std::vector<std::string> torque_limit_spots(const LogFacts& log, const Robot& robot);
/// Lists the stretches in which a joint could not be judged (LogFacts::unjudged), a sentence each for the
/// first few, and the number of the others.
std::vector<std::string> unjudged_spots(const LogFacts& log);
/// "joint 2 could not be judged from 1.200 s to 9.990 s, the end of the log: its torque is missing".
std::string unjudged_words(const UnjudgedStretch& stretch, const LogFacts& log);

/// Lists second residuals of the model whose signals a log lacks, a sentence each; `judged_s` by relation.
std::vector<std::string> relation_spots(const std::vector<SignalRelation>& relations,
                                        const std::vector<double>& judged_s);

/// Lists drives whose commanded torque went beyond the healthy logs, which do not show what the drive can
/// give there; a sentence each. `beyond_s`: by relation, for how long, s.
std::vector<std::string> drive_limit_spots(const std::vector<SignalRelation>& relations,
                                           const std::vector<double>& beyond_s, const Chain& chain);

/// Share of the simulated faults that a model found, 0 to 1; NaN if none were simulated.
double power_of(const Validation& validation);

/// Lists the kinds of which the model found too few simulated faults, a sentence each.
std::vector<std::string> weak_spots(const Validation& validation);

/// States how much larger faults must be at joints where the model misses more torque than in the learned
/// logs (Diagnosis::roughness): one sentence, or none.
std::vector<std::string> rough_spots(const std::vector<double>& roughness);

/// States the size below which a fault may be missed, a sentence for each kind that has a size.
std::vector<std::string> detectability_sentences(const std::vector<Detectability>& reach, const Chain& chain);

/// The size from which on a fault is surely found, such as "22 %" or "0.004 rad"; "at any size" if no size is
/// large enough to be surely found, "" for kinds without a size.
std::string detectable_size_text(const Detectability& reach, const Chain& chain);

}  // namespace faultline
