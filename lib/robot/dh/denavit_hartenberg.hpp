// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "lib/robot/chain.hpp"
#include "lib/robot/robot.hpp"
#include "lib/robot/toml/toml_table.hpp"

namespace faultline {

/// Convention of a Denavit-Hartenberg table. Rx, Rz are turns about and Tx, Tz shifts along x and z.
enum class DhConvention {
  standard,  ///< from frame i-1 to i: Rz(theta) Tz(d) Tx(a) Rx(alpha); joint i moves about or along z of i-1
  modified,  ///< Rx(alpha) Tx(a) Rz(theta) Tz(d); joint i moves about or along z of i (Craig)
};

/// A row of the table. A revolute joint turns by theta + q, a prismatic one slides to d + q.
struct DhRow {
  double a = 0.0;      ///< m
  double alpha = 0.0;  ///< rad
  double d = 0.0;      ///< m
  double theta = 0.0;  ///< rad
};

/// Placement of the joints and of the tip, as a table describes them.
struct DhGeometry {
  /// Origins on the z axes of the table's frames, of frame i-1 for joint i of a standard table and of frame i
  /// for a modified one, in link frames parallel to the base at q = 0. `direction` is zero.
  std::vector<JointGeometry> joints;
  /// Vector from the last joint's origin to the origin of the table's last frame at q = 0, m.
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();
};

/// `kinds` and `rows` have one entry for each joint, base to tip.
DhGeometry dh_geometry(const std::vector<AxisKind>& kinds, const std::vector<DhRow>& rows,
                       DhConvention convention);

// Tables in a robot file: `dh` or `mdh` in each [[joint]].

/// Whether the joint's table has a row of the standard (`dh`) or the modified (`mdh`) convention.
bool has_dh_row(const TomlTable& joint);
/// Returns the robot with geometry and tip of the rows, if there are any. Fails if only some joints have a
/// row, if both conventions are mixed, or if another key places joints too: `axes`, axis, offset, direction,
/// lengths.
Robot read_dh(const TomlTable& table, const std::vector<TomlTable>& joints, Robot robot);

}  // namespace faultline
