// SPDX-License-Identifier: MIT
#include "lib/identify/wanted_parameters.hpp"

#include <algorithm>
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
    for (const int p : {space.offset(j), space.bend(j), space.skew(j)}) {
      wanted.optional[p] = true;
      wanted.asked[p] = try_offsets;
    }
    if (is_exact("fo" + number)) wanted.asked[space.offset(j)] = false;
    if (is_exact("fb" + number)) wanted.asked[space.bend(j)] = false;
    if (is_exact("fs" + number)) wanted.asked[space.skew(j)] = false;
  }
  for (int p = space.extra_begin(); p < space.timing(); ++p) {
    const int joint = space.joint_of(p);
    const bool given =
        space.extra_at(p).kind == ExtraKind::load_friction && is_exact("fl" + std::to_string(joint + 1));
    wanted.optional[p] = true;
    wanted.asked[p] = !given && std::count(still.begin(), still.end(), joint + 1) == 0;
  }
  for (int joint : still)
    for (int p : {space.viscous(joint - 1), space.coulomb(joint - 1), space.offset(joint - 1),
                  space.bend(joint - 1), space.skew(joint - 1)})
      wanted.asked[p] = false;
  wanted.asked[space.timing()] = robot.log.torque_between_samples == TorqueTiming::unknown;
  return wanted;
}

}  // namespace faultline
