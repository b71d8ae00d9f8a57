// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/log/log_source.hpp"
#include "lib/residual/relation/signal_relation.hpp"

namespace faultline {

struct RelationOptions {
  bool torque_is_commanded = true;  ///< what `tau` is, where commanded and measured torque are not both there
  double period_s = 0.0;            ///< usual one of the logs
  double least_share = 0.005;       ///< of what the target reaches that any mean may stray
  double torque_offset = 0.01;      ///< share of the largest torque by which a healthy drive may be off
  double alarms_per_hour = 0.01;    ///< that each relation may raise by chance
  double torque_gain = 0.02;        ///< share of its torque by which it may be off
};

/// The relations that the healthy logs show, of each joint that has the signals: least squares over all logs,
/// limits from residuals of logs that were left out of the fit. A law that does not explain nearly all of the
/// command is none. Needs logs that rewind; leaves them at their end.
std::vector<SignalRelation> learn_relations(std::span<LogSource* const> healthy,
                                            const RelationOptions& options);

}  // namespace faultline
