// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "lib/balance/one_step/one_step_model.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

struct CoarseFitOptions {
  int rounds = 12;  ///< of Gauss-Newton steps, smoothed trajectories and noise in turn
  bool torque_is_held = false;
};

/// The robot, what differs by day and the noise of its readings from healthy logs of one coarse rate, without
/// a derivative: the parameters and effects of each day that make the innovations of the one-step prediction
/// smallest, about trajectories that are smoothed in turn; the variance of the effects and the noise that the
/// smoothed trajectories leave (expectation and maximisation). `robot` says which lengths are known,
/// and where it predicts the logs better than momentum differences do, it is the start; `space` gives base
/// parameters.
OneStepModel fit_coarse_days(std::span<LogSource* const> logs, const Robot& robot,
                             const ParameterSpace& space, const CoarseFitOptions& options = {});

}  // namespace faultline
