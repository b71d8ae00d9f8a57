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
  int parent = 0, child = 0;                                 ///< indices of `links`
  Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();  ///< the child's frame in the parent's at q = 0
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();           ///< unit vector in the child's frame
  double damping = 0.0;                                      ///< N m s/rad or N s/m
  double friction = 0.0;                                     ///< N m or N
  bool mimics = false;                                       ///< follows another joint
};

/// Masses and motion of a URDF file, without its meshes and colours.
struct UrdfModel {
  std::string file;
  std::string name;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;
  std::optional<std::string> more;  ///< content of <faultline>: what URDF cannot hold
};

/// Throws Error(input) if the file is larger than any plausible URDF (32 MiB).
void check_urdf_size(std::uintmax_t bytes, const std::string& file);

/// Parses a URDF. Throws Error(input) naming file, line and element if the text is not valid: broken XML,
/// missing attributes, invalid numbers, unknown links, repeated names. robot_from_urdf() checks whether links
/// and joints form a robot.
UrdfModel parse_urdf(const std::string& text, const std::string& file);

}  // namespace faultline
