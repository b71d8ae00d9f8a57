// SPDX-License-Identifier: MIT
#include "lib/robot/urdf/urdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/robot/urdf/serial_chain.hpp"
#include "lib/robot/urdf/urdf_more.hpp"

namespace faultline {
namespace {

constexpr double kStartMass = 1.0;      // kg
constexpr double kStartInertia = 0.01;  // kg m^2

[[noreturn]] void fail(const UrdfModel& model, int line, const char* what, const std::string& name,
                       const std::string& message) {
  throw Error(ErrorCode::input,
              fmt::format("{}, line {}, {} \"{}\"", model.file, line, what, printable(name)), message);
}

/// Identified numbers may be negative: one choice among those that move alike. Others may not.
void refuse_negative(const UrdfModel& model) {
  for (const UrdfLink& link : model.links) {
    if (!link.body) continue;
    if (link.body->mass < 0.0)
      fail(model, link.line, "link", link.name,
           fmt::format("has a mass of {} kg; expected one that is not negative", link.body->mass));
    if (link.body->inertia.diagonal().minCoeff() < 0.0)
      fail(model, link.line, "link", link.name,
           "has a negative moment of inertia; expected ixx, iyy and izz that are not negative");
  }
  for (const UrdfJoint& joint : model.joints)
    if (joint.damping < 0.0 || joint.friction < 0.0)
      fail(model, joint.line, "joint", joint.name,
           "has a negative damping or friction; expected numbers that are not negative");
}

bool finite(const Chain<double>& chain) {
  return std::all_of(chain.geometry.begin(), chain.geometry.end(),
                     [](const JointGeometry& j) { return j.axis.allFinite() && j.offset.allFinite(); }) &&
         std::all_of(chain.links.begin(), chain.links.end(), [](const LinkInertia<double>& link) {
           return std::isfinite(link.mass) && link.first_moment.allFinite() && link.inertia.allFinite();
         });
}

}  // namespace

bool has_urdf_name(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
  return extension == ".urdf";
}

Robot load_urdf_file(const std::string& path) {
  std::error_code unknown;
  const auto bytes = std::filesystem::file_size(path, unknown);
  if (!unknown) check_urdf_size(bytes, path);
  return robot_from_urdf(read_file(path), path);
}

Robot robot_from_urdf(const std::string& text, const std::string& file) {
  const UrdfModel model = parse_urdf(text, file);
  if (!model.more) refuse_negative(model);
  const UrdfChain from = serial_chain(model);
  const std::size_t n = from.joints.size();
  Robot robot;
  robot.name = model.name;
  robot.shapes.assign(n, LinkShape::general);
  Chain<double>& chain = robot.chain;
  chain.geometry = from.geometry;
  chain.length.assign(n, 0.0);
  chain.rotor_inertia.assign(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const UrdfJoint& joint = model.joints[from.joints[i]];
    chain.links.push_back(from.weighed ? from.bodies[i]
                                       : general_body(kStartMass, Eigen::Vector3d::Zero(),
                                                      kStartInertia * Eigen::Matrix3d::Identity()));
    chain.friction.push_back({.viscous = joint.damping, .coulomb = joint.friction});
  }
  if (!finite(chain))
    throw Error(ErrorCode::input, file, "has numbers so large that they overflow; expected SI units");
  if (model.more)
    read_urdf_more(robot, *model.more, file + ", <faultline>");
  else
    set_tip(robot, from.tip);
  return robot;
}

}  // namespace faultline
