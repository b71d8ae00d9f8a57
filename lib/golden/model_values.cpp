// SPDX-License-Identifier: MIT
#include "lib/golden/model_values.hpp"

#include <algorithm>

#include "lib/fault/label_text.hpp"
#include "lib/identify/parameter_space.hpp"

namespace faultline {
namespace {

double identified_std(const Identification& identification, const std::string& name) {
  for (const auto* list : {&identification.base_parameters, &identification.physical_parameters})
    for (const ParameterEstimate& parameter : *list)
      if (parameter.name == name && parameter.identifiable) return parameter.std;
  return std::numeric_limits<double>::quiet_NaN();
}

void add_robot(const Model& model, std::vector<ParameterValue>& values) {
  const ParameterSpace space = parameter_space(model.robot);
  const Eigen::VectorXd parameters =
      parameters_of(space, model.robot.chain, model.robot.torque_phi.value_or(0.0));
  for (int p = 0; p < space.timing(); ++p) {
    const std::string name = space.name(p);
    values.push_back(
        {"model_" + name, parameters[p], identified_std(model.identification, name), space.unit(p)});
  }
}

}  // namespace

std::vector<ParameterValue> values_of(const Model& model) {
  std::vector<ParameterValue> values;
  if (!model.has_mechanics()) return values;
  add_robot(model, values);
  const double no_std = std::numeric_limits<double>::quiet_NaN();
  for (int k = 1; k < kFaultKinds; ++k) {
    const auto kind = static_cast<FaultKind>(k);
    values.push_back(
        {std::string("threshold_") + to_string(kind), model.explain.limits.of(kind), no_std, "nats"});
  }
  return values;
}

}  // namespace faultline
