// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/balance/balance_model.hpp"
#include "lib/balance/work_piece.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

struct DayFitOptions {
  double kernel_s = 0.0;  ///< 0: 12 ms above 200 Hz, else 16 ms
  double row_s = 0.0;     ///< between two rows; 0: twice the kernel, since finer rows repeat each other
  int filter_order = 3;   ///< of the autoregression of the rows
  int rounds = 10;        ///< of parameters, days and noise in turn
  bool torque_is_held = false;
  bool springs = true, ripples = true, pieces = true;
};

/// When a work piece was carried in a log.
struct PieceTimes {
  Eigen::VectorXd time_s;  ///< of the rows
  PiecePath path;          ///< level in each; empty without a work piece
};

/// A robot from its healthy logs, and the same by all of them but each one in turn: what a log shows that was
/// not learned from. Only what is linear is fitted anew: terms, widths and noise stay.
struct FittedDays {
  BalanceModel model;
  std::vector<BalanceModel> without;  ///< by log
  std::vector<PieceTimes> pieces;     ///< by log
};

/// The robot, how it differs from day to day and the noise of its rows, from healthy logs (at least two of
/// one rate): a regression with mixed effects, the robot's parameters free and each day's effects random
/// (Laird and Ware 1982). `space` gives base parameters and lengths.
FittedDays fit_days(std::span<LogSource* const> logs, const ParameterSpace& space,
                    const DayFitOptions& options = {});

}  // namespace faultline
