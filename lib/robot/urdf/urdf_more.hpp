// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/robot/robot.hpp"

/// What URDF cannot hold of a robot, as TOML with the keys of a robot file.
namespace faultline {

std::string urdf_more_text(const Robot& robot);

/// Adds it to a robot that was read from the rest of the file; what that says of joints, masses and friction
/// stays as it is. Throws Error(usage) naming `where`, line and key, also when it is of a robot with other
/// joints.
void read_urdf_more(Robot& robot, const std::string& text, const std::string& where);

/// The link's body about its centre, as URDF has it; false when that cannot be turned back to the same
/// numbers, as with a first moment without mass.
bool about_centre(const LinkInertia& link, Eigen::Vector3d& centre, Eigen::Matrix3d& inertia);

}  // namespace faultline
