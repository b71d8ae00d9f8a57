// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/log/log_source.hpp"
#include "lib/residual/relation/signal_relation.hpp"

namespace faultline {

struct RelationOptions {
  bool torque_is_commanded = true;  ///< `tau` is the commanded torque; else the measured one
  double period_s = 0.0;            ///< usual one of the logs
  double least_share = 0.005;       ///< least limit of a mean, as a share of target_scale()
  double torque_offset = 0.01;      ///< share of the largest torque by which a healthy drive may deviate
  double alarms_per_hour = 0.01;    ///< false alarms by chance of each relation
  double torque_gain = 0.02;        ///< share of its torque by which a healthy drive may deviate
};

/// Learns the relations of each joint that has the signals: weights by least squares over all healthy logs,
/// limits from residuals of held-out logs. A control law that does not explain nearly all of the command is
/// left out. Needs logs that rewind; leaves them at their end.
std::vector<SignalRelation> learn_relations(std::span<LogSource* const> healthy,
                                            const RelationOptions& options);

}  // namespace faultline
