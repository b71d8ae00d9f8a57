// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "lib/robot/chain.hpp"
#include "lib/robot/spatial_dynamics.hpp"

namespace faultline {

/// The functions of dynamics.hpp for one chain with fixed parameters, some ten times faster if all its axes
/// are parallel (every SCARA, a planar arm, a single axis) and equal to 1e-12; SpatialDynamics computes them
/// for any other chain. Parallel axes split the problem: prismatic joints depend on masses only, and the
/// revolute joints form a planar arm, whose kinetic energy in absolute link rates w is 1/2 sum A_ij w_i w_j
/// with A_ij = alpha_ij cos(theta_j - theta_i) + beta_ij sin(theta_j - theta_i). Does not allocate on the
/// heap after construction; safe to share between threads.
class FastDynamics {
 public:
  explicit FastDynamics(const Chain& chain);

  int joints() const { return joints_; }
  /// Whether all axes are parallel, so that the fast path is in use.
  bool planar() const { return planar_; }
  const Chain& chain() const { return chain_; }
  /// Whether the rigid-body torque can depend on the position or the velocity of a joint.
  bool depends_on_position(int j) const {
    return !planar_ || (depends_on_velocity(j) && (gravity_in_plane_ || j != revolute_joint_[0]));
  }
  bool depends_on_velocity(int j) const { return !planar_ || chain_.geometry[j].kind == AxisKind::revolute; }

  /// M(q) and h(q, dq) + G(q).
  void inertia_and_bias(const JointVector& q, const JointVector& dq, JointMatrix& inertia,
                        JointVector& bias) const;
  /// Sines and cosines of a position, which the torques of all robots with the same axes share.
  struct Pose {
    std::array<double, kMaxJoints> sine, cosine;  ///< of the angle between a revolute body and the one before
    std::array<double, kMaxJoints> up, along;     ///< sine and cosine of its absolute angle; only for gravity
  };
  /// Only for parallel axes, see planar().
  Pose pose(const JointVector& q) const;
  /// M ddq + h + G in a pose, without shared drives. Only for parallel axes.
  JointVector planar_torque(const Pose& pose, const JointVector& dq, const JointVector& ddq) const;
  /// M ddq + h + G.
  JointVector body_torque(const JointVector& q, const JointVector& dq, const JointVector& ddq) const;
  /// Momentum M dq and the part dT/dq - G of its rate that is neither motor torque nor friction, both without
  /// shared drives.
  void momentum_and_force(const JointVector& q, const JointVector& dq, JointVector& momentum,
                          JointVector& force) const;
  /// F(dq).
  void friction(const JointVector& dq, JointVector& torque) const;
  /// Torque that a drive torque `tau` loses before it moves bodies: friction, load friction, ripples.
  void drag(const JointVector& q, const JointVector& dq, const JointVector& tau, JointVector& torque) const;
  /// The rigid bodies at one position and velocity.
  struct BodiesAt {
    JointMatrix factor;   ///< of M(q), see factor_small()
    JointVector bias;     ///< h(q, dq) + G(q)
    unsigned locked = 0;  ///< joints that do not accelerate; bit 0 is the first joint
  };
  BodiesAt bodies_at(const JointVector& q, const JointVector& dq, unsigned locked = 0) const;
  /// ddq = M^-1 (tau - drag - h - G): the drag at `q` and `dq`, M and h + G as in `bodies`, which may be
  /// those of a state nearby.
  void acceleration(const BodiesAt& bodies, const JointVector& q, const JointVector& dq,
                    const JointVector& tau, JointVector& ddq) const;
  /// The same with the bodies at `q` and `dq`.
  void acceleration(const JointVector& q, const JointVector& dq, const JointVector& tau, JointVector& ddq,
                    unsigned locked = 0) const {
    acceleration(bodies_at(q, dq, locked), q, dq, tau, ddq);
  }

 private:
  template <typename T>
  using PerJoint = std::array<T, kMaxJoints>;
  struct Pair {
    double alpha, beta;
  };
  /// The mass-dependent terms of the fast path, linear in masses, first moments and inertias; only the
  /// entries of the chain's joints are set.
  struct Bodies {
    PerJoint<double> diagonal;       ///< A_ii of each revolute body
    PerJoint<PerJoint<Pair>> pairs;  ///< A_ij, i < j
    PerJoint<Pair> gravity;  ///< gravity torque on revolute body i: alpha cos theta_i + beta sin theta_i
    PerJoint<double> carried_mass;  ///< of the joint's link and all links beyond it
    PerJoint<double> weight;        ///< gravity force on a prismatic joint
    PerJoint<double> rotor_inertia;
  };

  void set_up_planar(const Eigen::Vector3d& normal);
  void planar_inertia_and_bias(const JointVector& q, const JointVector& dq, JointMatrix& inertia,
                               JointVector& bias) const;
  /// Gravity torque on revolute body i.
  double gravity_on(int i, const Pose& pose) const;
  /// Adds the products of `motion` with the inertia of the prismatic joints and of the rotors.
  void add_slides_and_rotors(const JointVector& motion, JointVector& sum) const;

  Chain chain_;
  int joints_ = 0;
  bool planar_ = false;
  bool has_friction_ = false;
  bool has_extra_ = false;  ///< ripples, load friction or shared drives
  bool gravity_in_plane_ = false;
  int revolute_ = 0;
  int prismatic_ = 0;
  PerJoint<int> revolute_joint_{};
  PerJoint<int> prismatic_joint_{};
  SpatialDynamics spatial_;  ///< used if not planar_
  PerJoint<double> sign_{};  ///< 1 if the joint's axis points along the common normal, -1 if against it
  Bodies bodies_{};
};

/// Replaces a symmetric positive definite n x n matrix (column-major) by its factors L D in the lower
/// columns, with D on the diagonal. Excludes the rows whose bit is set in `fixed`.
void factor_small(int n, double* a, unsigned fixed = 0);

/// Solves with the factors of factor_small() for the right side `b`, which x overwrites; x is 0 in the rows
/// of `fixed`.
void solve_factored(int n, const double* a, double* b, unsigned fixed = 0);

}  // namespace faultline
