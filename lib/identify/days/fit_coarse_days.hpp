// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "lib/balance/one_step/one_step_model.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// Estimates the robot, the effects of the days and the measurement noise from healthy logs of one coarse
/// rate, without a derivative: parameters and effects of each day minimise the innovations of the one-step
/// prediction about smoothed trajectories, which are renewed in turn with the variance of the effects and of
/// the noise (expectation and maximisation). `robot` gives the known lengths; it is the start if it predicts
/// the logs better than the fit of momentum differences. `space` gives base parameters.
OneStepModel fit_coarse_days(std::span<LogSource* const> logs, const Robot& robot,
                             const ParameterSpace& space, TorqueTiming torque_between_samples);

}  // namespace faultline
