// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/classify/fault_criterion.hpp"
#include "lib/reproduce/runs/alarm_score.hpp"

namespace faultline {

/// The alarms of apply_criterion for many settings in one pass over the outputs, an entry a setting. An alarm
/// is named by the output whose run, or whose sum, raised it.

/// The paper's criterion for g = 1 .. `most_g`.
std::vector<Alarms> sweep_consecutive(const OutputMeaning& meaning, const Eigen::VectorXd& time,
                                      const Eigen::MatrixXd& outputs, int most_g);
/// Summed log odds for each threshold (nats); no sample adds more than `sample_cap`.
std::vector<Alarms> sweep_log_odds(const OutputMeaning& meaning, const Eigen::VectorXd& time,
                                   const Eigen::MatrixXd& outputs, std::span<const double> thresholds,
                                   double sample_cap);

/// Log odds of each fault (rows) against fault-free at each sample, as the criterion adds them up.
Eigen::MatrixXd sample_log_odds(const OutputMeaning& meaning, const Eigen::MatrixXd& outputs,
                                double sample_cap);

/// The setting to use, from its scores on tuning runs, the most sensitive first: the first with the fewest
/// false alarms among those that find at least 90 % of what the best finds, and one step more for margin
/// where that costs no more than 1 % of the detections.
int choose_setting(std::span<const AlarmScore> tuning);

}  // namespace faultline
