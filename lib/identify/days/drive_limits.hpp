// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/balance/balance_model.hpp"
#include "lib/balance/uniform_log.hpp"

namespace faultline {

/// Returns the largest torque of each drive (BalanceModel::drive_limit): the one beyond which the torque that
/// healthy motion needs stays where it is while the logged command rises. 0 if the logs show none, as when
/// the log holds the torque after the limit. `model` has rigid columns, setting and static friction.
Eigen::VectorXd drive_limits(const std::vector<UniformLog>& logs, const BalanceModel& model);

}  // namespace faultline
