// SPDX-License-Identifier: MIT
#pragma once

#include "lib/diagnose/decision.hpp"
#include "lib/diagnose/monitored_episode.hpp"

namespace faultline {

/// An episode with its decision, from which a finding is made. What it refers to outlives it.
struct DecidedEpisode {
  const MonitoredEpisode& observed;
  const DecisionBasis& basis;
  Decision decision;
};

}  // namespace faultline
