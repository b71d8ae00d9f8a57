// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/core/joint.hpp"

namespace faultline {

inline constexpr int kMaxJoints = 8;

/// Vectors and matrices over the joints, base to tip; bounded in size so that they live on the stack.
using JointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxJoints, 1>;
using JointMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxJoints, kMaxJoints>;

enum class AxisKind { revolute, prismatic };

/// Placement of a joint. All link frames are parallel to the base frame at q = 0; link i's frame has its
/// origin on joint i's axis. Joint i's origin in the frame of link i-1 is offset + length(i-1) * direction.
struct JointGeometry {
  AxisKind kind = AxisKind::revolute;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< unit vector, in the frame of link i-1 at q = 0
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d direction =
      Eigen::Vector3d::UnitX();  ///< unit vector along link i-1; zero for the first joint
};

/// Mass distribution of a link in its own frame. Torques are linear in these ten numbers.
struct LinkInertia {
  double mass = 0.0;                                       ///< kg
  Eigen::Vector3d first_moment = Eigen::Vector3d::Zero();  ///< mass * centre of mass, kg m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();       ///< about the frame's origin, kg m^2
};

/// F(dq) = viscous dq + coulomb tanh(dq / width) + offset + bend tanh(dq / bend_width) + skew |dq|. A
/// negative bend is friction that falls with speed (Stribeck; Makkar et al. 2005), a positive one friction
/// whose slope falls with speed; the skew is viscous friction that differs by direction. In addition a gear
/// loses load |r| tanh(dq / width), where r = M ddq + h + G is the torque that it carries (extra_torque.hpp).
struct Friction {
  double viscous = 0.0;     ///< N m s/rad or N s/m
  double coulomb = 0.0;     ///< N m or N
  double offset = 0.0;      ///< N m or N: asymmetric friction, drive offset
  double width = 0.01;      ///< rad/s or m/s
  double bend = 0.0;        ///< N m or N
  double skew = 0.0;        ///< N m s/rad or N s/m
  double bend_width = 1.0;  ///< rad/s or m/s
  double load = 0.0;        ///< share of the torque carried, below 1
};

/// Returns the largest slope of the friction over dq, reached near rest, in N m s/rad or N s/m, if the drive
/// carries at most `torque` (N m or N).
double steepest(const Friction& friction, double torque = 0.0);

/// Torque cosine cos(rate q) + sine sin(rate q) that repeats with the position of a joint, caused by its
/// gear, motor or spindle.
struct Ripple {
  Joint joint{};
  double rate = 0.0;                ///< 1/rad or 1/m
  double cosine = 0.0, sine = 0.0;  ///< N m or N
};

/// A drive that moves several joints, at the speed s = along . dq. Its rotor and friction take the joint
/// torques along (rotor_inertia ds/dt + viscous s + coulomb tanh(s / width)).
struct SharedDrive {
  Eigen::VectorXd along;  ///< for each joint
  double viscous = 0.0, coulomb = 0.0, width = 0.01;
  double rotor_inertia = 0.0;  ///< kg m^2 or kg

  double speed(const double* dq) const {
    return along.dot(Eigen::Map<const Eigen::VectorXd>(dq, along.size()));
  }
};

/// Serial chain of revolute and prismatic axes with all parameters of its dynamics.
struct Chain {
  std::vector<JointGeometry> geometry;
  std::vector<double>
      length;  ///< of each link along the next joint's `direction`, m; the last one carries the tip
  std::vector<LinkInertia> links;
  std::vector<Friction> friction;
  std::vector<double> rotor_inertia;  ///< seen at the joint, kg m^2 or kg
  std::vector<Ripple> ripples;
  std::vector<SharedDrive> shared_drives;
  Eigen::Vector3d gravity = Eigen::Vector3d(0.0, 0.0, -9.81);  ///< in the base frame, m/s^2

  int joints() const { return static_cast<int>(geometry.size()); }
};

/// Uniform thin rod from the link's origin along `direction` (unit vector), as in the paper.
LinkInertia uniform_rod(double mass, double length, const Eigen::Vector3d& direction);
/// Point mass at the link's origin, as the third link of the paper's SCARA.
LinkInertia point_mass(double mass);
/// Body with centre of mass `centre` (m, link frame) and inertia about that centre (kg m^2).
LinkInertia general_body(double mass, const Eigen::Vector3d& centre,
                         const Eigen::Matrix3d& inertia_at_centre);

/// Transforms `body` from its own frame to the frame in which that frame has this rotation and position (m).
LinkInertia seen_from(const LinkInertia& body, const Eigen::Matrix3d& rotation,
                      const Eigen::Vector3d& position);

constexpr const char* position_unit(AxisKind kind) { return kind == AxisKind::revolute ? "rad" : "m"; }
constexpr const char* velocity_unit(AxisKind kind) { return kind == AxisKind::revolute ? "rad/s" : "m/s"; }
constexpr const char* torque_unit(AxisKind kind) { return kind == AxisKind::revolute ? "N m" : "N"; }
constexpr const char* viscous_unit(AxisKind kind) {
  return kind == AxisKind::revolute ? "N m s/rad" : "N s/m";
}

/// Returns for each joint whether it is prismatic.
inline std::vector<bool> sliding_joints(const Chain& chain) {
  std::vector<bool> slides;
  for (const auto& joint : chain.geometry) slides.push_back(joint.kind == AxisKind::prismatic);
  return slides;
}

}  // namespace faultline
