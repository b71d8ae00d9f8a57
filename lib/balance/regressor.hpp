// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "lib/robot/chain.hpp"

namespace faultline {

/// Number of parameters of a link: mass, first moment (x y z), inertia about the frame (xx yy zz xy xz yz).
inline constexpr int kLinkParameters = 10;

using LinkVector = Eigen::Matrix<double, kLinkParameters, 1>;

LinkVector to_vector(const LinkInertia& link);
LinkInertia link_from(const LinkVector& vector);

/// Motion of every link that one joint's unit rate causes, in the link's own frame: angular and linear
/// velocity of the frame's origin.
struct Twist {
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();
};

/// Kinematics of a chain at one configuration: twist[link][joint] for joint <= link, and gravity in the frame
/// of each link.
struct LinkFrames {
  std::array<std::array<Twist, kMaxJoints>, kMaxJoints> twist;
  std::array<Eigen::Vector3d, kMaxJoints> gravity;
  int joints = 0;
};

LinkFrames link_frames(const Chain& chain, const JointVector& q);

/// Rows of a quantity that is linear in the links' inertia: n x (10 n), link after link.
using LinkRegressor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxJoints,
                                    kMaxJoints * kLinkParameters>;

/// Writes the regressor of the momentum p = M(q) dq to `out`.
void momentum_regressor(const LinkFrames& frames, const JointVector& dq, LinkRegressor& out);
/// Writes the regressor of dp/dt without motor and friction: dT/dq - G(q), with the kinetic energy T.
void force_regressor(const LinkFrames& frames, const JointVector& dq, LinkRegressor& out);
/// Writes the regressor of the inverse dynamics M ddq + h + G; accelerations by the Newton-Euler recursion.
void torque_regressor(const Chain& chain, const JointVector& q, const JointVector& dq, const JointVector& ddq,
                      LinkRegressor& out);

}  // namespace faultline
