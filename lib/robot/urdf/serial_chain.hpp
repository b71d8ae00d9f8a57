// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/robot/urdf/urdf_model.hpp"

namespace faultline {

/// The serial chain in a tree of links, in frames parallel to the base's at q = 0.
struct UrdfChain {
  std::vector<int> joints;              ///< of the model, those that move, base to tip
  std::vector<JointGeometry> geometry;  ///< by offsets alone
  std::vector<LinkInertia<double>> bodies;
  bool weighed = false;                           ///< some moving body has a mass
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();  ///< the one end of what is fixed to the last joint; or zero
};

/// The longest chain of moving joints. What is fixed to a link belongs to it, and so does what branches off,
/// standing still at its zero. Throws Error(input) naming joints and links when the links are no tree, when
/// two chains are longest, and for chains without a joint, with more than kMaxJoints, or with joints that are
/// neither turns nor slides of their own.
UrdfChain serial_chain(const UrdfModel& model);

}  // namespace faultline
