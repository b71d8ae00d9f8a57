// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/robot/robot.hpp"

/// Reads and writes robots as URDF (wiki.ros.org/urdf/XML); docs/urdf.md.
namespace faultline {

/// Whether the file name ends in .urdf, in upper or lower case.
bool has_urdf_name(const std::string& path);

/// Reads the serial chain of a URDF as a robot: axes and origins; masses, inertias, damping and friction as
/// start values, links of shape `general`; lengths 0, gravity along -z. If no link has a mass, each gets 1 kg
/// and 0.01 kg m^2. Restores what urdf_text() wrote. `file` names it in errors. Throws Error(input) naming
/// file, line and element, Error(usage) for a <faultline> element that is not valid.
Robot robot_from_urdf(const std::string& text, const std::string& file);

/// Reads it from a file. Throws Error(input) if the file cannot be read.
Robot load_urdf_file(const std::string& path);

/// Returns the robot as URDF with links base, link1 .. and joints joint1 .., base to tip. A <faultline>
/// element holds what URDF cannot, with the keys of a robot file: read back, the robot moves exactly alike.
std::string urdf_text(const Robot& robot);

}  // namespace faultline
