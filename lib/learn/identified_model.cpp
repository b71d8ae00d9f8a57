// SPDX-License-Identifier: MIT
#include "lib/learn/identified_model.hpp"

#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

/// What a model keeps of the identification for those who ask how good it is.
Identification without_state(Identification identification) {
  identification.robot = {};
  identification.space = {};
  identification.estimate = {};
  identification.covariance = {};
  identification.logs.clear();  // the model's sources name them
  return identification;
}

}  // namespace

double identified_period_s(const Identification& identification) {
  std::vector<double> periods;
  for (const IdentifiedLog& log : identification.logs) periods.push_back(log.sample_period_s);
  return periods.empty() ? 0.0 : upper_median(periods);
}

Model identified_model(const Identification& identification) {
  Model model;
  model.name = identification.robot.name;
  model.robot = identification.robot;
  model.identification = without_state(identification);
  model.sample_period_s = identified_period_s(identification);
  model.has_velocity = !identification.dq_noise.empty();
  return model;
}

}  // namespace faultline
