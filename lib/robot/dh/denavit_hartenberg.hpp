// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "lib/robot/chain.hpp"

namespace faultline {

/// Whose rows a Denavit-Hartenberg table holds. With Rx, Rz turns and Tx, Tz shifts along x and z:
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

/// The transform of a row at q = 0.
Eigen::Isometry3d dh_transform(const DhRow& row, DhConvention convention);

/// Where the joints sit that a table describes, and the tip.
struct DhGeometry {
  /// Origins on the z axes of the table's frames, in their coordinates at q = 0 turned parallel to the base:
  /// of frame i-1 for joint i of a standard table, of frame i for a modified one. `direction` is zero.
  std::vector<JointGeometry> joints;
  /// From the last joint's origin to that of the table's last frame at q = 0, m.
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();
};

/// `kinds` and `rows` base to tip, one each a joint.
DhGeometry dh_geometry(const std::vector<AxisKind>& kinds, const std::vector<DhRow>& rows,
                       DhConvention convention);

}  // namespace faultline
