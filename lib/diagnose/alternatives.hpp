// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/diagnose/decided_episode.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/diagnose/sample_alarm.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// What a fault could also be: the networks' other opinions, labels with a good share of the votes, labels
/// whose evidence comes near that of the best, and the other joints that a push on all of them reached. Each
/// label once, with the first reason that named it, and never the fault's own.
std::vector<Alternative> alternatives_to(const DecidedEpisode& decided, const Model& model);

/// The words of single networks.
std::vector<Alternative> alternatives_to(const SampleAlarm& alarm);

}  // namespace faultline
