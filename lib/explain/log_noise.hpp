// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/balance_model.hpp"

namespace faultline {

class LogFit;

/// White noise of a log over that of the healthy logs, by joint.
Eigen::VectorXd row_loudness(const UniformLog& log, const BalanceModel& model);

/// Standard deviation of each row (rows x joints, N m or N): its noise, what a model of a machine lacks of
/// each of its terms, and the unknown force of an end stop.
Eigen::MatrixXd row_deviation(const BalanceRows& rows, const BalanceModel& model,
                              const Eigen::VectorXd& loudness);

/// The noise of a log as its rows before any change show it (first_change()), joint by joint where it is
/// louder than that of the healthy logs: a robot may have what no healthy log had, such as ripple or friction
/// that depends on load, and what it leaves from the first row on is no evidence for a fault that begins
/// later.
RowNoise own_noise(const LogFit& fit);

}  // namespace faultline
