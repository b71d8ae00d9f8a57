// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "lib/robot/chain.hpp"

namespace faultline {

/// M(q), h(q, dq) + G(q) and the momentum of a chain with any axes, in half the time of the recursions of
/// dynamics.hpp and equal to 1e-12: transforms all bodies to the base frame once, in which composite bodies
/// are sums and nothing has to be carried from link to link (Featherstone, Rigid Body Dynamics Algorithms,
/// 2008, chapters 2 and 6). Without shared drives. Does not allocate on the heap; safe to share between
/// threads.
class SpatialDynamics {
 public:
  SpatialDynamics() = default;
  explicit SpatialDynamics(const Chain& chain);

  void inertia_and_bias(const JointVector& q, const JointVector& dq, JointMatrix& inertia,
                        JointVector& bias) const;
  /// Momentum M dq and the part dT/dq - G of its rate that is neither motor torque nor friction.
  void momentum_and_force(const JointVector& q, const JointVector& dq, JointVector& momentum,
                          JointVector& force) const;

 private:
  struct Link {
    bool turns = true;
    Eigen::Vector3d axis, position;  ///< in the link before, at q = 0
    LinkInertia body;
    double rotor_inertia = 0.0;
  };

  struct Bodies;
  Bodies in_base(const JointVector& q, const JointVector& dq) const;

  int joints_ = 0;
  Eigen::Vector3d gravity_ = Eigen::Vector3d::Zero();
  std::array<Link, kMaxJoints> link_{};
};

}  // namespace faultline
