// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/balance/balance_model.hpp"
#include "lib/balance/uniform_log.hpp"

namespace faultline {

/// Standard deviation of the delay of a joint's torque beyond the lag of all torques, samples.
inline constexpr double kDelayStd = 0.3;

/// Whether no log has a velocity that is a second measurement: none, or the difference of the positions.
/// `logs` have the samples that were recorded, not means.
bool hold_no_velocity(const std::vector<UniformLog>& logs);

/// Setting of the rows of these logs as far as the logs alone show it: rate, noise, which velocity is
/// precise.
RowSetting draft_setting(const std::vector<UniformLog>& logs, double kernel_s, double row_s);

/// Chooses the lag of all torques, then the friction width of each joint, by what a rigid robot leaves
/// unexplained.
RowSetting with_chosen_lag_and_widths(const std::vector<UniformLog>& logs, const RigidColumns& rigid,
                                      RowSetting setting);

/// Least squares without noise model: each joint by its own residual `scale`; only columns of `used` are
/// free.
Eigen::VectorXd plain_fit(const std::vector<BalanceRows>& rows, const ColumnLayout& layout,
                          const std::vector<bool>& used, const Eigen::VectorXd& scale);

/// Columns of a robot without springs and ripples whose offsets are free where gravity does not hide them.
std::vector<bool> rigid_columns_used(const RigidColumns& rigid, const ColumnLayout& layout);

}  // namespace faultline
