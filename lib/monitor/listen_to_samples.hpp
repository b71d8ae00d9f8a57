// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/diagnosis/diagnosis.hpp"
#include "lib/monitor/log_tally.hpp"
#include "lib/residual/residual_summary.hpp"

namespace faultline {

/// What one pass over a log gives in the paper's mode.
struct HeardSamples {
  LogTally tally;
  std::vector<JointResidual> residuals;  ///< of the MLP, over the whole log
  std::vector<FaultFinding> faults;      ///< by the criterion on the average of both networks
};

/// The paper's diagnosis: residuals of the regenerated fault-free motion, both networks over each sample, the
/// fault criterion on their average (figure 2) and on each alone (figure 1), whose word becomes its opinion.
HeardSamples listen_to_samples(LogSource& log, const Model& model, const CriterionOptions& criterion);

}  // namespace faultline
