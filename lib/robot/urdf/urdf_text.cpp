// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lib/core/text.hpp"
#include "lib/robot/urdf/urdf.hpp"
#include "lib/robot/urdf/urdf_more.hpp"

namespace faultline {
namespace {

/// Replaces the characters with a meaning in XML by references.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

/// Replaces the quotes, too, for an attribute.
std::string attribute(const std::string& text) {
  std::string out;
  for (const char c : escaped(text)) out += c == '"' ? std::string("&quot;") : std::string(1, c);
  return out;
}

std::string triple(const Eigen::Vector3d& v) { return fmt::format("{} {} {}", v.x(), v.y(), v.z()); }

std::string urdf_link(const Robot& robot, int i) {
  const LinkInertia& link = robot.chain.links[i];
  const CentredBody body = about_centre(link);
  const Eigen::Matrix3d& inertia = body.inertia;
  return fmt::format(
      "  <link name=\"link{}\">\n"
      "    <inertial>\n"
      "      <origin xyz=\"{}\"/>\n"
      "      <mass value=\"{}\"/>\n"
      "      <inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" izz=\"{}\"/>\n"
      "    </inertial>\n"
      "  </link>\n",
      Joint::at(i), triple(body.centre), link.mass, inertia(0, 0), inertia(0, 1), inertia(0, 2),
      inertia(1, 1), inertia(1, 2), inertia(2, 2));
}

/// Returns a joint as URDF. URDF requires limits for prismatic joints; unknown here, they are wide.
std::string urdf_joint(const Robot& robot, int i) {
  const JointGeometry& joint = robot.chain.geometry[i];
  const Friction& friction = robot.chain.friction[i];
  Eigen::Vector3d origin = joint.offset;
  if (i > 0) origin += robot.chain.length[i - 1] * joint.direction;
  const bool turns = joint.kind == AxisKind::revolute;
  return fmt::format(
      "  <joint name=\"joint{}\" type=\"{}\">\n"
      "    <parent link=\"{}\"/>\n"
      "    <child link=\"link{}\"/>\n"
      "    <origin xyz=\"{}\"/>\n"
      "    <axis xyz=\"{}\"/>\n"
      "    <dynamics damping=\"{}\" friction=\"{}\"/>\n"
      "{}"
      "  </joint>\n",
      Joint::at(i), turns ? "continuous" : "prismatic", i ? fmt::format("link{}", Joint::at(i - 1)) : "base",
      Joint::at(i), triple(origin), triple(joint.axis), friction.viscous, friction.coulomb,
      turns ? "" : "    <limit lower=\"-1000\" upper=\"1000\" effort=\"1e9\" velocity=\"1000\"/>\n");
}

/// Returns the tip as a fixed link of its own; "" if the last link has no length or its joint is prismatic.
std::string tip_text(const Robot& robot) {
  const int last = robot.joints() - 1;
  const double reach = robot.chain.length[last];
  if (reach == 0.0 || robot.chain.geometry[last].kind == AxisKind::prismatic) return "";
  return fmt::format(
      "  <link name=\"tip\"/>\n"
      "  <joint name=\"to_tip\" type=\"fixed\">\n"
      "    <parent link=\"link{}\"/>\n"
      "    <child link=\"tip\"/>\n"
      "    <origin xyz=\"{}\"/>\n"
      "  </joint>\n",
      Joint::at(last), triple(reach * link_direction(robot, last)));
}

}  // namespace

std::string urdf_text(const Robot& robot) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<!-- Written by faultline. Frames are parallel to the base frame at zero. Limits are not known. -->\n"
      "<robot name=\"{}\">\n"
      "  <link name=\"base\"/>\n",
      attribute(printable(robot.name)));
  for (int i = 0; i < robot.joints(); ++i) text += urdf_joint(robot, i) + urdf_link(robot, i);
  text += tip_text(robot);
  return text + "  <faultline>\n" + escaped(urdf_more_text(robot)) + "  </faultline>\n</robot>\n";
}

}  // namespace faultline
