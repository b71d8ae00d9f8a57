// SPDX-License-Identifier: MIT
#include "lib/identify/identification.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/core/matrix/decompositions.hpp"

namespace faultline {

const char* to_string(IdentificationStatus status) {
  static constexpr std::array kNames{"not_run",        "converged",        "not_converged",
                                     "poorly_excited", "poorly_explained", "unexplained"};
  static_assert(kNames.size() == static_cast<std::size_t>(IdentificationStatus::unexplained) + 1);
  return kNames[static_cast<std::size_t>(status)];
}

const char* to_string(IdentifyMethod method) {
  static constexpr std::array kNames{"automatic", "weak_form", "output_error"};
  static_assert(kNames.size() == static_cast<std::size_t>(IdentifyMethod::output_error) + 1);
  return kNames[static_cast<std::size_t>(method)];
}

void Identification::take(const std::optional<FitStatus>& found) {
  if (!found) return;
  status = found->status;
  reason += "; " + found->reason;
}

Robot robot_with(const Robot& robot, const ParameterSpace& space, const Eigen::VectorXd& parameters) {
  Robot out = robot;
  out.chain = chain_from(space, parameters);
  for (Friction& friction : out.chain.friction) {  // noise can make the friction of a smooth joint negative
    friction.viscous = std::max(friction.viscous, 0.0);
    friction.coulomb = std::max(friction.coulomb, 0.0);
  }
  std::erase_if(out.chain.shared_drives, [](const SharedDrive& drive) {
    return drive.rotor_inertia == 0.0 && drive.viscous == 0.0 && drive.coulomb == 0.0;
  });
  out.torque_phi = std::clamp(parameters[space.timing()], 0.0, 1.0);
  out.identified = true;
  return out;
}

Robot draw(const Identification& id, Random& random, double spread) {
  const SymmetricEigen eigen = symmetric_eigen(id.covariance);
  Eigen::VectorXd p = id.estimate;
  for (Eigen::Index k = 0; k < p.size(); ++k)
    p += eigen.vectors.col(k) * (spread * std::sqrt(std::max(eigen.values[k], 0.0)) * random.normal());
  const ParameterSpace& space = id.space;
  for (int j = 0; j < space.joints(); ++j)
    for (int k : {space.viscous(j), space.coulomb(j)})
      if (id.estimate[k] >= 0.0) p[k] = std::max(p[k], 0.0);
  for (int k = 0; k < space.rigid(); ++k)
    if (space.base[k].is_mass && id.estimate[k] > 0.0) p[k] = std::max(p[k], 0.1 * id.estimate[k]);
  return robot_with(id.robot, space, p);
}

ParameterValue value_of(const ParameterEstimate& estimate) {
  return {estimate.name, estimate.value, estimate.std, estimate.unit};
}

const ParameterValue* find_value(const std::vector<ParameterValue>& values, const std::string& name) {
  const auto found = std::find_if(values.begin(), values.end(),
                                  [&](const ParameterValue& value) { return value.name == name; });
  return found == values.end() ? nullptr : &*found;
}

}  // namespace faultline
