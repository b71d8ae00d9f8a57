// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <span>

#include "lib/identify/gathered.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/identify/torque_fit.hpp"
#include "lib/identify/weak_form/weak_choice.hpp"
#include "lib/log/log_source.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// State of a model while it is chosen and its torque is fitted.
struct ModelDraft {
  WantedParameters wanted;
  Eigen::VectorXd nominal;  ///< values of parameters that are not fitted
  ModelChoice choice;
  TorqueFit torque;
};

/// Data of the logs, and the model that was chosen from them. Its space is that of the torque fit.
struct DraftedModel {
  Gathered gathered;
  ModelDraft draft;
};

/// Tries rare terms that the residual of a first model suggests: friction that grows with the load, friction
/// of a drive that several joints turn, ripples, gear compliance, torques logged too large or too small. If
/// any of them lowers the error on held-out data, returns the model chosen and fitted again with it, in a
/// space with its parameters; else the first model, with the terms tried. The data are gathered again for
/// that space.
DraftedModel take_extra_terms(std::span<LogSource* const> logs, const Robot& robot, DraftedModel first);

/// Returns the torque timing phi to start from: 0 if held, else that of `robot`, else 0.5.
double nominal_timing(const Robot& robot);

}  // namespace faultline
