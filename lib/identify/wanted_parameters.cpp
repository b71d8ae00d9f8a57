// SPDX-License-Identifier: MIT
#include "lib/identify/wanted_parameters.hpp"

#include <string>

namespace faultline {

WantedParameters wanted_parameters(const ParameterSpace& space, const Robot& robot,
                                   const std::vector<int>& still, bool try_offsets) {
  WantedParameters wanted{std::vector<bool>(space.count(), true), std::vector<bool>(space.count(), false)};
  const auto is_exact = [&](const std::string& name) {
    const auto it = robot.known.find(name);
    return it != robot.known.end() && it->second.std == 0.0;
  };
  for (int p = 0; p < space.rigid(); ++p)
    if (space.base[p].is_rotor) wanted.optional[p] = true;
  for (int j = 0; j < space.joints(); ++j) {
    const std::string number = std::to_string(j + 1);
    if (is_exact("fv" + number)) wanted.asked[space.viscous(j)] = false;
    if (is_exact("fc" + number)) wanted.asked[space.coulomb(j)] = false;
    wanted.optional[space.offset(j)] = true;
    if (!try_offsets || is_exact("fo" + number)) wanted.asked[space.offset(j)] = false;
  }
  for (int joint : still)
    wanted.asked[space.viscous(joint - 1)] = wanted.asked[space.coulomb(joint - 1)] =
        wanted.asked[space.offset(joint - 1)] = false;
  wanted.asked[space.timing()] = robot.log.torque_between_samples == TorqueTiming::unknown;
  return wanted;
}

}  // namespace faultline
