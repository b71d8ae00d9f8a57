// SPDX-License-Identifier: MIT
#include "lib/robot/parameter.hpp"

#include <charconv>
#include <utility>

namespace faultline {
namespace {

constexpr std::pair<const char*, double Friction::*> kFrictionTerms[] = {
    {"fv", &Friction::viscous}, {"fc", &Friction::coulomb}, {"fo", &Friction::offset},
    {"fb", &Friction::bend},    {"fs", &Friction::skew},    {"fl", &Friction::load}};

}  // namespace

std::vector<std::string> parameter_names(int joints) {
  std::vector<std::string> names;
  for (const char* prefix : {"m", "l", "fv", "fc", "fo", "fb", "fs", "fl", "jr"})
    for (int j = 1; j <= joints; ++j) names.push_back(prefix + std::to_string(j));
  return names;
}

bool set_parameter(Robot& robot, const std::string& name, double value) {
  const std::size_t digits = name.find_first_of("0123456789");
  int joint = 0;
  if (digits == std::string::npos || digits == 0) return false;
  const auto [end, error] = std::from_chars(name.data() + digits, name.data() + name.size(), joint);
  if (error != std::errc() || end != name.data() + name.size() || joint < 1 || joint > robot.joints())
    return false;
  const std::string what = name.substr(0, digits);
  const int i = joint - 1;
  Chain& chain = robot.chain;
  LinkInertia& link = chain.links[i];
  for (const auto& [prefix, term] : kFrictionTerms) {
    if (what != prefix) continue;
    chain.friction[i].*term = value;
    return true;
  }
  if (what == "jr")
    chain.rotor_inertia[i] = value;
  else if (what == "l")
    chain.length[i] = value;
  else if (what != "m")
    return false;
  if (robot.shapes[i] == LinkShape::rod && (what == "m" || what == "l")) {
    link = uniform_rod(what == "m" ? value : link.mass, chain.length[i], link_direction(robot, i));
  } else if (robot.shapes[i] == LinkShape::point && what == "m") {
    link = point_mass(value);
  } else if (what == "m") {  // a general body keeps its shape: everything scales with the mass
    const double ratio = link.mass > 0.0 ? value / link.mass : 0.0;
    link = {value, ratio * link.first_moment, ratio * link.inertia};
  }
  return true;
}

}  // namespace faultline
