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
  values.push_back({"trigger", model.evidence.trigger, no_std, "std"});
  values.push_back({"threshold", model.evidence.threshold, no_std, "nats"});
  for (const Imitation& imitation : model.evidence.imitations)
    values.push_back({"threshold_" + label_text(imitation.label, "_"),
                      model.evidence.threshold + imitation.nats, no_std, "nats"});
  return values;
}

}  // namespace faultline
