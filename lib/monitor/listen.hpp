// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "lib/evidence/episode_evidence.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"
#include "lib/monitor/log_tally.hpp"
#include "lib/residual/residual_summary.hpp"

namespace faultline {

/// What one pass over a log gives before anything is decided.
struct Heard {
  LogTally tally;
  std::vector<EpisodeEvidence> episodes;
  std::vector<std::vector<JointResidual>>
      episode_residuals;                 ///< of the MLP, an entry an episode, from onset on
  std::vector<JointResidual> residuals;  ///< of the MLP, over the whole log
  int rejected_alarms = 0;
  double largest_ratio = 0.0;  ///< that raised no alarm
};

/// The loop of the whole program: every segment goes through the residuals of the regenerated fault-free
/// motion and through the bank. Memory does not grow with the log, and where segments end changes nothing.
/// Throws Error(input) when the log has other joints than the model's robot, or no torque.
Heard listen(LogSource& log, const Model& model);

}  // namespace faultline
