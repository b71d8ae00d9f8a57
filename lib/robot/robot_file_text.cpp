// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lib/robot/robot_file.hpp"
#include "lib/robot/robot_words.hpp"

namespace faultline {
namespace {

/// Shortest text that reads back as the same double.
std::string number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

template <typename Values>
std::string numbers(const Values& values) {
  std::string text = "[";
  for (int i = 0; i < static_cast<int>(values.size()); ++i) text += (i ? ", " : "") + number(values[i]);
  return text + "]";
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + "\"";
}

std::string tensor(const Eigen::Matrix3d& m) {
  const std::vector<double> values{m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
  return numbers(values);
}

std::string joint_text(const Robot& robot, int i) {
  const JointGeometry& joint = robot.chain.geometry[i];
  const Friction<double>& f = robot.chain.friction[i];
  std::string text = "\n[[joint]]\n";
  text += fmt::format("kind = \"{}\"\n", to_string(joint.kind));
  text += fmt::format("axis = {}\noffset = {}\n", numbers(joint.axis), numbers(joint.offset));
  if (!joint.direction.isZero()) text += fmt::format("direction = {}\n", numbers(joint.direction));
  if (robot.identified) return text;  // [identified] has the rest
  text += fmt::format("friction = {{viscous = {}, coulomb = {}, offset = {}, width = {}}}\n",
                      number(f.viscous), number(f.coulomb), number(f.offset), number(f.width));
  return text + fmt::format("rotor_inertia = {}\n", number(robot.chain.rotor_inertia[i]));
}

std::string link_text(const Robot& robot, int i) {
  const LinkInertia<double>& link = robot.chain.links[i];
  const LinkShape shape = robot.shapes[i];
  std::string text = fmt::format("\n[[link]]\nshape = \"{}\"\n", to_string(shape));
  if (robot.identified) return text;  // [identified] has the rest
  text += fmt::format("mass = {}\nlength = {}\n", number(link.mass), number(robot.chain.length[i]));
  if (shape == LinkShape::general)
    text += fmt::format("first_moment = {}\ninertia_at_joint = {}\n", numbers(link.first_moment),
                        tensor(link.inertia));
  return text;
}

std::string fact_text(const std::string& key, const KnownValue& fact) {
  if (fact.std == 0.0) return fmt::format("{} = {}\n", key, number(fact.value));
  return fmt::format("{} = {{value = {}, std = {}}}\n", key, number(fact.value), number(fact.std));
}

std::string facts_text(const Robot& robot) {
  std::string text;
  if (!robot.known.empty()) text += "\n[known]\n";
  for (const auto& [key, fact] : robot.known) text += fact_text(key, fact);
  if (!robot.payloads.empty()) text += "\n[payload]\n";
  for (const auto& [key, fact] : robot.payloads) text += fact_text(quoted(key), fact);
  return text;
}

std::string column_text(const std::string& channel, const ColumnSpec& spec) {
  return fmt::format("{} = {{name = {}, unit = {}, sign = {}, scale = {}, offset = {}}}\n", channel,
                     quoted(spec.name), quoted(spec.unit), number(spec.sign), number(spec.scale),
                     number(spec.offset));
}

std::string coupling_text(const Eigen::MatrixXd& coupling) {
  std::string text = "coupling = [";
  for (int i = 0; i < coupling.rows(); ++i)
    text += (i ? ", " : "") + numbers(Eigen::VectorXd(coupling.row(i).transpose()));
  return text + "]\n";
}

std::string log_text(const LogMeaning& log) {
  std::string text = fmt::format("\n[log]\ntorque = \"{}\"\ntorque_between_samples = \"{}\"\n",
                                 to_string(log.torque), to_string(log.torque_between_samples));
  if (log.coupling.size() > 0) text += coupling_text(log.coupling);
  if (!log.columns.empty()) text += "\n[log.columns]\n";
  for (const auto& [channel, spec] : log.columns) text += column_text(channel, spec);
  return text;
}

std::string identified_text(const Robot& robot) {
  std::string text = "\n[identified]\n";
  if (robot.torque_phi) text += fmt::format("torque_phi = {}\n", number(*robot.torque_phi));
  if (!robot.torque_delay_s.empty())
    text += fmt::format("torque_delay_s = {}\n", numbers(robot.torque_delay_s));
  for (int i = 0; i < robot.joints(); ++i) {
    const LinkInertia<double>& link = robot.chain.links[i];
    const Friction<double>& f = robot.chain.friction[i];
    text += fmt::format(
        "\n[[identified.joint]]\nlength = {}\nmass = {}\nfirst_moment = {}\ninertia = {}\nviscous = {}\n"
        "coulomb = {}\noffset = {}\nwidth = {}\nrotor_inertia = {}\n",
        number(robot.chain.length[i]), number(link.mass), numbers(link.first_moment), tensor(link.inertia),
        number(f.viscous), number(f.coulomb), number(f.offset), number(f.width),
        number(robot.chain.rotor_inertia[i]));
  }
  return text;
}

}  // namespace

std::string robot_file_text(const Robot& robot) {
  std::string text = fmt::format("name = {}\n", quoted(robot.name));
  if (!robot.axes.empty()) text += fmt::format("axes = {}\n", quoted(robot.axes));
  text += fmt::format("gravity = {}\n", numbers(robot.chain.gravity));
  for (int i = 0; i < robot.joints(); ++i) text += joint_text(robot, i);
  for (int i = 0; i < robot.joints(); ++i) text += link_text(robot, i);
  text += facts_text(robot) + log_text(robot.log);
  if (robot.identified) text += identified_text(robot);
  return text;
}

}  // namespace faultline
