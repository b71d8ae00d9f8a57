// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/decide_log.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {

/// A stretch of a log that the healthy robot does not explain, as found by monitoring and before the
/// decision.
struct MonitoredEpisode {
  ExplainedFault fault;
  double end_s = 0.0;                      ///< when the fault ended, or the last sample that was judged
  std::vector<JointResidual> residuals{};  ///< of the MLP, by joint, over kEpisodeResiduals_s from the onset

  double onset_s() const { return fault.claim.onset_s; }
  double alarm_s() const { return fault.alarm_s; }
};

}  // namespace faultline
