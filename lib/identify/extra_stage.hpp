// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>

#include "lib/identify/gathered.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/torque_fit.hpp"
#include "lib/identify/wanted_parameters.hpp"
#include "lib/identify/weak_form/weak_choice.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// State of a model while it is chosen and its torque is fitted.
struct ModelDraft {
  WantedParameters wanted;
  Eigen::VectorXd nominal;  ///< values of parameters that are not fitted
  ModelChoice choice;
  TorqueFit torque;
};

/// Tries rare terms that the residual of a first model suggests: friction that grows with the load, friction
/// of a drive that several joints turn, ripples, gear compliance, torques logged too large or too small. If
/// any of them lowers the error on held-out data, the model is chosen and fitted again with it; its
/// parameters join those of `id.space`. Does nothing if the residual is negligible.
void take_extra_terms(std::span<LogSource* const> logs, Gathered& gathered, Identification& id,
                      ModelDraft& draft);

/// Returns the torque timing phi to start from: 0 if held, else that of `robot`, else 0.5.
double nominal_timing(const Robot& robot);

}  // namespace faultline
