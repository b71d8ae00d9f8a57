// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace faultline {

inline constexpr int kMaxJoints = 8;

/// Vectors and matrices over the joints, base to tip; bounded in size so that they live on the stack.
template <typename S>
using JointVector = Eigen::Matrix<S, Eigen::Dynamic, 1, 0, kMaxJoints, 1>;
template <typename S>
using JointMatrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxJoints, kMaxJoints>;
template <typename S>
using Vector3 = Eigen::Matrix<S, 3, 1>;
template <typename S>
using Matrix3 = Eigen::Matrix<S, 3, 3>;

enum class AxisKind { revolute, prismatic };

/// Where a joint sits. All link frames are parallel to the base frame at q = 0; link i's frame has its origin
/// on joint i's axis. Joint i's origin in the frame of link i-1 is offset + length(i-1) * direction.
struct JointGeometry {
  AxisKind kind = AxisKind::revolute;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< unit vector, in the frame of link i-1 at q = 0
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d direction =
      Eigen::Vector3d::UnitX();  ///< unit vector along link i-1; zero for the first joint
};

/// Mass distribution of a link in its own frame. Torques are linear in these ten numbers.
template <typename S>
struct LinkInertia {
  S mass = S(0.0);                               ///< kg
  Vector3<S> first_moment = Vector3<S>::Zero();  ///< mass * centre of mass, kg m
  Matrix3<S> inertia = Matrix3<S>::Zero();       ///< about the frame's origin, kg m^2
};

/// F(dq) = viscous dq + coulomb tanh(dq / width) + offset + bend tanh(dq / bend_width) + skew |dq|. A
/// negative bend is friction that falls with speed (Stribeck; Makkar et al. 2005), a positive one friction
/// that rises ever less; the skew is viscous friction that differs by direction. Beside it a gear
/// loses load |r| tanh(dq / width), r the torque M ddq + h + G that it carries (see extra_torque.hpp).
template <typename S>
struct Friction {
  S viscous = S(0.0);     ///< N m s/rad or N s/m
  S coulomb = S(0.0);     ///< N m or N
  S offset = S(0.0);      ///< N m or N: asymmetric friction, drive offset
  S width = S(0.01);      ///< rad/s or m/s
  S bend = S(0.0);        ///< N m or N
  S skew = S(0.0);        ///< N m s/rad or N s/m
  S bend_width = S(1.0);  ///< rad/s or m/s
  S load = S(0.0);        ///< share of the torque carried, below 1
};

/// Largest rise of friction with dq, near rest, of a drive that carries at most `torque`.
template <typename S>
S steepest(const Friction<S>& f, const S& torque = S(0.0)) {
  using std::abs;
  return f.viscous + (abs(f.coulomb) + abs(f.load) * torque) / f.width + abs(f.bend) / f.bend_width +
         abs(f.skew);
}

/// Torque that repeats with a joint's position, of its gear, motor or spindle: cosine cos(rate q) + sine
/// sin(rate q).
struct Ripple {
  int joint = 0;                    ///< from 0
  double rate = 0.0;                ///< 1/rad or 1/m
  double cosine = 0.0, sine = 0.0;  ///< N m or N
};

/// A drive that turns with several joints, at the speed s = along . dq: its rotor and friction take
/// along (rotor_inertia ds/dt + viscous s + coulomb tanh(s / width)).
struct SharedDrive {
  Eigen::VectorXd along;  ///< by joint
  double viscous = 0.0, coulomb = 0.0, width = 0.01;
  double rotor_inertia = 0.0;  ///< kg m^2 or kg

  double speed(const double* dq) const {
    return along.dot(Eigen::Map<const Eigen::VectorXd>(dq, along.size()));
  }
};

/// Serial chain of revolute and prismatic axes with its parameters: all that dynamics needs.
template <typename S>
struct Chain {
  std::vector<JointGeometry> geometry;
  std::vector<S>
      length;  ///< of each link along the next joint's `direction`, m; the last one carries the tip
  std::vector<LinkInertia<S>> links;
  std::vector<Friction<S>> friction;
  std::vector<S> rotor_inertia;  ///< seen at the joint, kg m^2 or kg
  std::vector<Ripple> ripples;
  std::vector<SharedDrive> shared_drives;
  Eigen::Vector3d gravity = Eigen::Vector3d(0.0, 0.0, -9.81);  ///< in the base frame, m/s^2

  int joints() const { return static_cast<int>(geometry.size()); }
};

/// The same chain with its parameters in another scalar type.
template <typename T, typename S>
Chain<T> cast_chain(const Chain<S>& chain) {
  Chain<T> out;
  out.geometry = chain.geometry;
  out.gravity = chain.gravity;
  out.ripples = chain.ripples;
  out.shared_drives = chain.shared_drives;
  for (const S& l : chain.length) out.length.push_back(T(l));
  for (const S& i : chain.rotor_inertia) out.rotor_inertia.push_back(T(i));
  for (const auto& link : chain.links)
    out.links.push_back(
        {T(link.mass), link.first_moment.template cast<T>(), link.inertia.template cast<T>()});
  for (const auto& f : chain.friction)
    out.friction.push_back({T(f.viscous), T(f.coulomb), T(f.offset), T(f.width), T(f.bend), T(f.skew),
                            T(f.bend_width), T(f.load)});
  return out;
}

/// Uniform thin rod from the link's origin along `direction` (unit), as in the paper.
LinkInertia<double> uniform_rod(double mass, double length, const Eigen::Vector3d& direction);
/// Point mass on the link's origin, as the third link of the paper's SCARA.
LinkInertia<double> point_mass(double mass);
/// Body with centre of mass `centre` (m, link frame) and inertia about that centre (kg m^2).
LinkInertia<double> general_body(double mass, const Eigen::Vector3d& centre,
                                 const Eigen::Matrix3d& inertia_at_centre);

/// A body given in a frame of its own, seen from the frame in which that one stands so.
LinkInertia<double> seen_from(const LinkInertia<double>& body, const Eigen::Matrix3d& rotation,
                              const Eigen::Vector3d& position);

}  // namespace faultline
