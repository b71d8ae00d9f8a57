// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lib/robot/robot.hpp"
#include "lib/robot/robot_file.hpp"
#include "lib/robot/robot_file_parts.hpp"
#include "lib/robot/toml/toml_values.hpp"

namespace faultline {
namespace {

/// Returns the friction terms that are 0 for most joints (bend, skew, load), if they are not 0.
std::string rare_friction_text(const Friction& f, const char* separator) {
  std::string text;
  if (f.bend != 0.0 || f.skew != 0.0)
    text = fmt::format("{0}bend = {1}{0}bend_width = {2}{0}skew = {3}", separator, toml_number(f.bend),
                       toml_number(f.bend_width), toml_number(f.skew));
  if (f.load != 0.0) text += fmt::format("{}load = {}", separator, toml_number(f.load));
  return text;
}

std::string by_joint_text(const char* key, const std::vector<double>& values) {
  if (values.empty()) return "";
  return fmt::format("{} = {}\n", key,
                     toml_numbers(Eigen::Map<const Eigen::VectorXd>(
                         values.data(), static_cast<Eigen::Index>(values.size()))));
}

std::string toml_joint(const Robot& robot, int i) {
  const JointGeometry& joint = robot.chain.geometry[i];
  const Friction& f = robot.chain.friction[i];
  std::string text = "\n[[joint]]\n";
  text += fmt::format("kind = \"{}\"\n", to_string(joint.kind));
  text += fmt::format("axis = {}\noffset = {}\n", toml_numbers(joint.axis), toml_numbers(joint.offset));
  if (!joint.direction.isZero()) text += fmt::format("direction = {}\n", toml_numbers(joint.direction));
  if (robot.identified) return text;  // [identified] holds the other values
  text += fmt::format("friction = {{viscous = {}, coulomb = {}, offset = {}, width = {}{}}}\n",
                      toml_number(f.viscous), toml_number(f.coulomb), toml_number(f.offset),
                      toml_number(f.width), rare_friction_text(f, ", "));
  return text + fmt::format("rotor_inertia = {}\n", toml_number(robot.chain.rotor_inertia[i]));
}

std::string toml_link(const Robot& robot, int i) {
  const LinkInertia& link = robot.chain.links[i];
  const LinkShape shape = robot.shapes[i];
  std::string text = fmt::format("\n[[link]]\nshape = \"{}\"\n", to_string(shape));
  if (robot.identified) return text;  // [identified] holds the other values
  text += fmt::format("mass = {}\nlength = {}\n", toml_number(link.mass), toml_number(robot.chain.length[i]));
  if (shape == LinkShape::general)
    text += fmt::format("first_moment = {}\ninertia_at_joint = {}\n", toml_numbers(link.first_moment),
                        toml_tensor(link.inertia));
  return text;
}

std::string fact_text(const std::string& key, const KnownValue& fact) {
  if (fact.std == 0.0) return fmt::format("{} = {}\n", key, toml_number(fact.value));
  return fmt::format("{} = {{value = {}, std = {}}}\n", key, toml_number(fact.value), toml_number(fact.std));
}

std::string coupling_text(const Eigen::MatrixXd& coupling) {
  std::string text = "coupling = [";
  for (int i = 0; i < coupling.rows(); ++i)
    text += (i ? ", " : "") + toml_numbers(coupling.row(i).transpose());
  return text + "]\n";
}

std::string recording_text(const RecordingChoice& choice) {
  std::string text;
  if (!choice.topic.empty()) text += fmt::format("topic = {}\n", toml_quoted(choice.topic));
  if (choice.time) text += fmt::format("time = {}\n", toml_quoted(to_string(*choice.time)));
  if (choice.joints.empty()) return text;
  std::string names;
  for (const std::string& joint : choice.joints) names += (names.empty() ? "" : ", ") + toml_quoted(joint);
  return text + fmt::format("joints = [{}]\n", names);
}

/// Returns the keys that say where the values of a channel come from.
std::string column_text(const ColumnSpec& spec) {
  if (spec.topic.empty()) return fmt::format("name = {}", toml_quoted(spec.name));
  return fmt::format("topic = {}, field = {}", toml_quoted(spec.topic),
                     toml_quoted(spec.name.substr(spec.topic.size() + 1)));
}

std::string log_text(const LogMeaning& log) {
  std::string text = fmt::format("\n[log]\ntorque = \"{}\"\ntorque_between_samples = \"{}\"\n",
                                 to_string(log.torque), to_string(log.torque_between_samples));
  text += recording_text(log.recording);
  if (log.coupling.size() > 0) text += coupling_text(log.coupling);
  if (!log.columns.empty()) text += "\n[log.columns]\n";
  for (const auto& [channel, spec] : log.columns)
    text += fmt::format("{} = {{{}, unit = {}, sign = {}, scale = {}, offset = {}}}\n", channel,
                        column_text(spec), toml_quoted(spec.unit), toml_number(spec.sign),
                        toml_number(spec.scale), toml_number(spec.offset));
  return text;
}

std::string identified_text(const Robot& robot) {
  std::string text = "\n[identified]\n";
  if (robot.torque_phi) text += fmt::format("torque_phi = {}\n", toml_number(*robot.torque_phi));
  text += drive_text(robot);
  for (int i = 0; i < robot.joints(); ++i) {
    const LinkInertia& link = robot.chain.links[i];
    const Friction& f = robot.chain.friction[i];
    text += fmt::format(
        "\n[[identified.joint]]\nlength = {}\nmass = {}\nfirst_moment = {}\ninertia = {}\nviscous = {}\n"
        "coulomb = {}\noffset = {}\nwidth = {}{}\nrotor_inertia = {}\n",
        toml_number(robot.chain.length[i]), toml_number(link.mass), toml_numbers(link.first_moment),
        toml_tensor(link.inertia), toml_number(f.viscous), toml_number(f.coulomb), toml_number(f.offset),
        toml_number(f.width), rare_friction_text(f, "\n"), toml_number(robot.chain.rotor_inertia[i]));
  }
  return text + extra_torque_text(robot.chain, "identified.");
}

}  // namespace

std::string extra_torque_text(const Chain& chain, const std::string& prefix) {
  std::string text;
  for (const Ripple& r : chain.ripples)
    text += fmt::format("\n[[{}ripple]]\njoint = {}\nrate = {}\ncosine = {}\nsine = {}\n", prefix, r.joint,
                        toml_number(r.rate), toml_number(r.cosine), toml_number(r.sine));
  for (const SharedDrive& f : chain.shared_drives)
    text += fmt::format(
        "\n[[{}shared_drive]]\nalong = {}\nviscous = {}\ncoulomb = {}\nwidth = {}\n"
        "rotor_inertia = {}\n",
        prefix, toml_numbers(f.along), toml_number(f.viscous), toml_number(f.coulomb), toml_number(f.width),
        toml_number(f.rotor_inertia));
  return text;
}

std::string drive_text(const Robot& robot) {
  return by_joint_text("torque_delay_s", robot.torque_delay_s) +
         by_joint_text("torque_gain", robot.torque_gain) + by_joint_text("torque_limit", robot.torque_limit) +
         by_joint_text("gear_compliance", robot.gear_compliance);
}

std::string facts_text(const Robot& robot) {
  std::string text;
  if (!robot.known.empty()) text += "\n[known]\n";
  for (const auto& [key, fact] : robot.known) text += fact_text(key, fact);
  if (!robot.payloads.empty()) text += "\n[payload]\n";
  for (const auto& [key, fact] : robot.payloads) text += fact_text(toml_quoted(key), fact);
  return text + log_text(robot.log) + normal_range_text(robot.normal) + least_sizes_text(robot.least_sizes);
}

std::string robot_file_text(const Robot& robot) {
  std::string text = fmt::format("name = {}\n", toml_quoted(robot.name));
  if (!robot.axes.empty()) text += fmt::format("axes = {}\n", toml_quoted(robot.axes));
  text += fmt::format("gravity = {}\n", toml_numbers(robot.chain.gravity));
  for (int i = 0; i < robot.joints(); ++i) text += toml_joint(robot, i);
  for (int i = 0; i < robot.joints(); ++i) text += toml_link(robot, i);
  if (!robot.identified) text += extra_torque_text(robot.chain, "");
  text += facts_text(robot);
  if (robot.identified) text += identified_text(robot);
  return text;
}

}  // namespace faultline
