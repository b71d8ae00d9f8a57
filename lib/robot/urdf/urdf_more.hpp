// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>

#include "lib/robot/robot.hpp"

/// The properties of a robot that URDF cannot hold, as TOML with the keys of a robot file.
namespace faultline {

std::string urdf_more_text(const Robot& robot);

/// Returns `robot`, which was read from the rest of the file, with these properties; its joints, masses and
/// friction stay as they are. Throws Error(usage) naming `where`, line and key, also if the text belongs to a
/// robot with other joints.
Robot read_urdf_more(const std::string& text, const std::string& where, Robot robot);

/// A link as URDF needs it.
struct CentredBody {
  Eigen::Vector3d centre;      ///< of mass, m
  Eigen::Matrix3d inertia;     ///< about it, kg m^2
  bool converts_back = false;  ///< to the same numbers; not so for a first moment without mass
};

CentredBody about_centre(const LinkInertia& link);

}  // namespace faultline
