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

/// A model on its way: what the torque is fitted with.
struct ModelDraft {
  WantedParameters wanted;
  Eigen::VectorXd nominal;  ///< values of parameters that are not fitted
  ModelChoice choice;
  TorqueFit torque;
};

/// What few robots have and the torque left over of a first model asks for: friction that grows with the
/// load, friction of a drive that several joints turn, ripples, gears that give way, torques logged too large
/// or too small. Where something of it pays on held-out data, the model is chosen and fitted again with it;
/// its parameters join those of `id.space`. A model that leaves next to nothing is not looked at.
void take_extra_terms(std::span<LogSource* const> logs, Gathered& gathered, Identification& id,
                      ModelDraft& draft);

/// How torque is taken to run between samples where the robot does not say it.
double nominal_timing(const Robot& robot);

}  // namespace faultline
