// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lib/robot/chain.hpp"

namespace faultline {

enum class UrdfJointType { revolute, continuous, prismatic, fixed, floating, planar };

struct UrdfLink {
  std::string name;
  int line = 0;
  std::optional<LinkInertia> body;  ///< in the link's frame
};

struct UrdfJoint {
  std::string name;
  int line = 0;
  UrdfJointType type = UrdfJointType::fixed;
  int parent = 0, child = 0;                                 ///< of `links`
  Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();  ///< the child's frame in the parent's at q = 0
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();           ///< unit vector in the child's frame
  double damping = 0.0;                                      ///< N m s/rad or N s/m
  double friction = 0.0;                                     ///< N m or N
  bool mimics = false;                                       ///< follows another joint
};

/// What a URDF file says of masses and motion; what it draws is left out.
struct UrdfModel {
  std::string file;
  std::string name;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;
  std::optional<std::string> more;  ///< content of <faultline>: what URDF cannot hold
};

/// Throws Error(input) for more bytes than a URDF has.
void check_urdf_size(std::uintmax_t bytes, const std::string& file);

/// Throws Error(input) naming file, line and element when the text is no URDF that can be understood: broken
/// XML, missing attributes, numbers that are none, unknown links, names given twice. Whether links and joints
/// make a robot is judged by robot_from_urdf().
UrdfModel parse_urdf(const std::string& text, const std::string& file);

}  // namespace faultline
