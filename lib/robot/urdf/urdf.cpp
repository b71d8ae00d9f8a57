// SPDX-License-Identifier: MIT
#include "lib/robot/urdf/urdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>
#include <vector>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/robot/turns.hpp"
#include "lib/robot/urdf/urdf_model.hpp"
#include "lib/robot/urdf/urdf_more.hpp"

namespace faultline {
namespace {

constexpr double kStartMass = 1.0;      // kg, if no link has a mass
constexpr double kStartInertia = 0.01;  // kg m^2, if no link has a mass
constexpr std::size_t kNamesShown = 4;
constexpr int kNone = -1;

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kNamesShown); ++i)
    text += (i ? ", \"" : "\"") + printable(names[i]) + "\"";
  return text + (names.size() > kNamesShown ? fmt::format(" and {} more", names.size() - kNamesShown) : "");
}

[[noreturn]] void fail(const UrdfModel& model, const std::string& message) {
  throw Error(ErrorCode::input, model.file, message);
}

[[noreturn]] void fail(const UrdfModel& model, const UrdfLink& link, const std::string& message) {
  throw Error(ErrorCode::input,
              fmt::format("{}, line {}, link \"{}\"", model.file, link.line, printable(link.name)), message);
}

[[noreturn]] void fail(const UrdfModel& model, const UrdfJoint& joint, const std::string& message) {
  throw Error(ErrorCode::input,
              fmt::format("{}, line {}, joint \"{}\"", model.file, joint.line, printable(joint.name)),
              message);
}

bool moves(const UrdfJoint& joint) { return joint.type != UrdfJointType::fixed; }

/// Links and joints as a tree.
struct Tree {
  std::vector<int> joint_to;                ///< each link's joint towards the base, or kNone
  std::vector<std::vector<int>> joints_of;  ///< each link's joints away from the base
  std::vector<int> order;                   ///< links, each after its parent
  std::vector<int> depth;                   ///< moving joints between base and link
};

/// Returns the only link that is no joint's child; fails if there is none or several.
int root_of(const UrdfModel& model, const Tree& tree) {
  std::vector<std::string> names;
  int root = kNone;
  for (std::size_t l = 0; l < model.links.size(); ++l)
    if (tree.joint_to[l] == kNone) names.push_back(model.links[l].name), root = static_cast<int>(l);
  if (model.links.empty()) fail(model, "has no <link>; a robot has a base, links and joints");
  if (names.empty()) fail(model, "has no base: every link is the child of a joint, so the links form a loop");
  if (names.size() > 1)
    fail(model, fmt::format("has several bases: {}; join them by fixed joints or leave out those that do not "
                            "belong to the robot",
                            listed(names)));
  return root;
}

Tree tree_of(const UrdfModel& model) {
  Tree tree;
  tree.joint_to.assign(model.links.size(), kNone);
  tree.joints_of.resize(model.links.size());
  tree.depth.assign(model.links.size(), 0);
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const UrdfJoint& joint = model.joints[j];
    int& before = tree.joint_to[joint.child];
    if (before != kNone)
      fail(model, joint,
           fmt::format("has as its child the link \"{}\", which is the child of joint \"{}\" too; "
                       "closed chains are not possible",
                       printable(model.links[joint.child].name), printable(model.joints[before].name)));
    before = static_cast<int>(j);
    tree.joints_of[joint.parent].push_back(static_cast<int>(j));
  }
  tree.order.push_back(root_of(model, tree));
  for (std::size_t at = 0; at < tree.order.size(); ++at) {
    const int link = tree.order[at];
    for (const int j : tree.joints_of[link]) {
      tree.depth[model.joints[j].child] = tree.depth[link] + moves(model.joints[j]);
      tree.order.push_back(model.joints[j].child);
    }
  }
  if (tree.order.size() == model.links.size()) return tree;
  const std::set<int> reached(tree.order.begin(), tree.order.end());
  std::vector<std::string> lost;
  for (std::size_t l = 0; l < model.links.size(); ++l)
    if (!reached.count(static_cast<int>(l))) lost.push_back(model.links[l].name);
  fail(model, fmt::format("has links that form a loop apart from the base: {}", listed(lost)));
}

/// Returns the last joint of the longest chain of moving joints; fails if several chains are longest.
int last_joint(const UrdfModel& model, const Tree& tree) {
  const int longest = *std::max_element(tree.depth.begin(), tree.depth.end());
  if (longest == 0) fail(model, "has no moving joint; expected revolute, continuous or prismatic ones");
  std::vector<std::string> tips;
  int last = kNone;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const UrdfJoint& joint = model.joints[j];
    if (!moves(joint) || tree.depth[joint.child] != longest) continue;
    tips.push_back(model.links[joint.child].name);
    last = static_cast<int>(j);
  }
  if (tips.size() > 1)
    fail(model,
         fmt::format("branches into {} chains of {} each, with the tips {}; make the joints fixed that do "
                     "not belong to the arm",
                     tips.size(), counted(longest, "moving joint"), listed(tips)));
  if (longest > kMaxJoints)
    fail(model, fmt::format("has a chain of {} moving joints; expected at most {}", longest, kMaxJoints));
  return last;
}

void refuse(const UrdfModel& model, const UrdfJoint& joint) {
  if (joint.type == UrdfJointType::floating || joint.type == UrdfJointType::planar)
    fail(model, joint,
         fmt::format("is {}; a chain turns or slides about single axes. Make it fixed, or leave it out",
                     joint.type == UrdfJointType::planar ? "planar" : "floating"));
  if (joint.mimics)
    fail(model, joint,
         "mimics another joint, so it is not an independent axis; make it fixed, or leave out its <mimic>");
}

std::vector<int> joints_to(const UrdfModel& model, const Tree& tree, int last) {
  std::vector<int> joints;
  for (int j = last; j != kNone; j = tree.joint_to[model.joints[j].parent])
    if (moves(model.joints[j])) joints.insert(joints.begin(), j);
  return joints;
}

/// Position (m) of the end of the links fixed to the last joint's link, from that joint; zero if they branch.
Eigen::Vector3d tip_of(const UrdfModel& model, const Tree& tree, int last,
                       const std::vector<Eigen::Isometry3d>& pose) {
  const int begin = model.joints[last].child;
  int link = begin;
  while (tree.joints_of[link].size() == 1) link = model.joints[tree.joints_of[link][0]].child;
  if (!tree.joints_of[link].empty()) return Eigen::Vector3d::Zero();
  return without_dust(pose[link].translation() - pose[begin].translation());
}

/// The serial chain in a tree of links, in frames parallel to the base's at q = 0.
struct UrdfChain {
  std::vector<int> joints;              ///< indices of the model's moving joints of the chain, base to tip
  std::vector<JointGeometry> geometry;  ///< placed by offsets alone
  std::vector<LinkInertia> bodies;
  bool weighed = false;                           ///< whether a moving body has a mass
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();  ///< see tip_of()
};

/// Returns the longest chain of moving joints. Each link includes what is fixed to it and all side branches,
/// held at their zero positions. Throws Error(input) naming joints and links if the links form no tree, if
/// two chains are longest, and for chains without a joint, with more than kMaxJoints joints, or with
/// floating, planar or mimic joints.
UrdfChain serial_chain(const UrdfModel& model) {
  const Tree tree = tree_of(model);
  for (const UrdfJoint& joint : model.joints)
    if (joint.type == UrdfJointType::floating || joint.type == UrdfJointType::planar) refuse(model, joint);
  const int last = last_joint(model, tree);
  UrdfChain chain;
  chain.joints = joints_to(model, tree, last);
  chain.bodies.resize(chain.joints.size());
  std::vector<Eigen::Isometry3d> pose(model.links.size(), Eigen::Isometry3d::Identity());
  std::vector<int> owner(model.links.size(), kNone);  // the joint of the chain that carries the link
  std::vector<Eigen::Vector3d> place;                 // origins of the chain's joints, in the base frame
  for (const int link : tree.order) {
    const int j = tree.joint_to[link];
    if (j == kNone) continue;
    const UrdfJoint& joint = model.joints[j];
    pose[link] = pose[joint.parent] * joint.origin;
    owner[link] = owner[joint.parent];
    if (std::find(chain.joints.begin(), chain.joints.end(), j) != chain.joints.end()) {
      refuse(model, joint);
      const Eigen::Vector3d before = place.empty() ? Eigen::Vector3d::Zero() : place.back();
      owner[link] = static_cast<int>(place.size());
      place.push_back(pose[link].translation());
      chain.geometry.push_back(
          {joint.type == UrdfJointType::prismatic ? AxisKind::prismatic : AxisKind::revolute,
           without_dust(pose[link].linear() * joint.axis).normalized(), without_dust(place.back() - before),
           Eigen::Vector3d::Zero()});
    }
    if (owner[link] == kNone || !model.links[link].body) continue;
    const LinkInertia body = seen_from(*model.links[link].body, pose[link].linear(),
                                       pose[link].translation() - place[owner[link]]);
    LinkInertia& all = chain.bodies[owner[link]];
    all = {all.mass + body.mass, all.first_moment + body.first_moment, all.inertia + body.inertia};
    chain.weighed = true;
  }
  chain.tip = tip_of(model, tree, last, pose);
  return chain;
}

/// Fails for negative masses, inertias, damping or friction, which are valid only as identified numbers.
void refuse_negative(const UrdfModel& model) {
  for (const UrdfLink& link : model.links) {
    if (!link.body) continue;
    if (link.body->mass < 0.0)
      fail(model, link,
           fmt::format("has a mass of {} kg; expected one that is not negative", link.body->mass));
    if (link.body->inertia.diagonal().minCoeff() < 0.0)
      fail(model, link, "has a negative moment of inertia; expected ixx, iyy and izz that are not negative");
  }
  for (const UrdfJoint& joint : model.joints)
    if (joint.damping < 0.0 || joint.friction < 0.0)
      fail(model, joint, "has a negative damping or friction; expected numbers that are not negative");
}

bool finite(const Chain& chain) {
  return std::all_of(chain.geometry.begin(), chain.geometry.end(),
                     [](const JointGeometry& j) { return j.axis.allFinite() && j.offset.allFinite(); }) &&
         std::all_of(chain.links.begin(), chain.links.end(), [](const LinkInertia& link) {
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
  Chain& chain = robot.chain;
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
  if (model.more) return read_urdf_more(*model.more, file + ", <faultline>", std::move(robot));
  return with_tip(std::move(robot), from.tip);
}

}  // namespace faultline
