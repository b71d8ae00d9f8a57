// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/balance_model.hpp"

namespace faultline {

/// White noise of a log over that of the healthy logs, by joint.
Eigen::VectorXd row_loudness(const UniformLog& log, const BalanceModel& model);

/// Standard deviation of each row (rows x joints, N m or N): its noise, what a model of a machine lacks of
/// each of its terms, and the unknown force of an end stop.
Eigen::MatrixXd row_deviation(const BalanceRows& rows, const BalanceModel& model,
                              const Eigen::VectorXd& loudness);

}  // namespace faultline
