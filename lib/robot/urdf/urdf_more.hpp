// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/robot/robot.hpp"

/// The properties of a robot that URDF cannot hold, as TOML with the keys of a robot file.
namespace faultline {

std::string urdf_more_text(const Robot& robot);

/// Adds them to a robot that was read from the rest of the file, whose joints, masses and friction stay as
/// they are. Throws Error(usage) naming `where`, line and key, also if the text belongs to a robot with other
/// joints.
void read_urdf_more(Robot& robot, const std::string& text, const std::string& where);

/// Returns by reference the link's centre of mass (m) and inertia about it (kg m^2), as URDF needs them;
/// false if they do not convert back to the same numbers, as for a first moment without mass.
bool about_centre(const LinkInertia& link, Eigen::Vector3d& centre, Eigen::Matrix3d& inertia);

}  // namespace faultline
