// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/balance/balance_model.hpp"
#include "lib/balance/work_piece.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// Times at which a work piece was carried in a log.
struct PieceTimes {
  Eigen::VectorXd time_s;  ///< of the rows
  PiecePath path;          ///< level in each row; empty without a work piece
};

/// A robot fitted to its healthy logs, and to all of them but each one in turn, so that each log can be
/// judged as held out. Fits without a log renew only linear parameters and day variance, not terms or noise.
struct FittedDays {
  BalanceModel model;
  std::vector<BalanceModel> without;  ///< by log
  std::vector<PieceTimes> pieces;     ///< by log
};

/// Estimates the robot, its differences from day to day and the noise of its rows from healthy logs (at least
/// two, of one rate): a regression with mixed effects, in which the parameters of the robot are free and the
/// effects of each day random (Laird and Ware 1982). `space` gives base parameters and lengths, `drive_limit`
/// the limits of the drives to which the torques are cut (BalanceModel::drive_limit); without them they are
/// estimated (drive_limits()).
FittedDays fit_days(std::span<LogSource* const> logs, const ParameterSpace& space,
                    TorqueTiming torque_between_samples, const std::vector<double>& drive_limit = {});

}  // namespace faultline
