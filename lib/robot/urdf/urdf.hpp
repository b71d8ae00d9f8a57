// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/robot/robot.hpp"

/// Robots as URDF (wiki.ros.org/urdf/XML), in and out; docs/urdf.md.
namespace faultline {

/// Whether a file is named so (.urdf), whatever the case.
bool has_urdf_name(const std::string& path);

/// The serial chain of a URDF as a robot: axes and origins; masses, inertias, damping and friction as start
/// values, links of shape `general`; lengths 0, gravity along -z. Without any mass, 1 kg and 0.01 kg m^2 a
/// link. What urdf_text() wrote comes back whole. `file` names it in errors. Throws Error(input) naming file,
/// line and element, Error(usage) for a <faultline> element that cannot be understood.
Robot robot_from_urdf(const std::string& text, const std::string& file);

/// The same from a file. Throws Error(input) when it cannot be read.
Robot load_urdf_file(const std::string& path);

/// The robot as URDF with links base, link1 .. and joints joint1 .., base to tip. A <faultline> element keeps
/// what URDF cannot hold, in the words of a robot file: read back, the robot moves exactly alike.
std::string urdf_text(const Robot& robot);

}  // namespace faultline
