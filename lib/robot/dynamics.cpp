// SPDX-License-Identifier: MIT
#include "lib/robot/dynamics.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {

Eigen::Matrix3d rotation_about(const Eigen::Vector3d& axis, double angle) {
  const auto [s, c] = elementary::sin_cos(angle);
  const double v = 1.0 - c;
  const double x = axis.x(), y = axis.y(), z = axis.z();
  Eigen::Matrix3d r;
  r << c + v * (x * x), v * (x * y) - s * z, v * (x * z) + s * y,  //
      v * (x * y) + s * z, c + v * (y * y), v * (y * z) - s * x,   //
      v * (x * z) - s * y, v * (y * z) + s * x, c + v * (z * z);
  return r;
}

LinkPose link_pose(const Chain& chain, int i, double q) {
  const JointGeometry& joint = chain.geometry[i];
  LinkPose pose;
  pose.position = joint.offset;
  if (i > 0) pose.position += chain.length[i - 1] * joint.direction;
  if (joint.kind == AxisKind::revolute) {
    pose.rotation = rotation_about(joint.axis, q);
  } else {
    pose.rotation = Eigen::Matrix3d::Identity();
    pose.position += q * joint.axis;
  }
  return pose;
}

JointVector rigid_body_torque(const Chain& chain, const JointVector& q, const JointVector& dq,
                              const JointVector& ddq, const Eigen::Vector3d& gravity) {
  const int n = chain.joints();
  std::array<LinkPose, kMaxJoints> pose;
  std::array<Eigen::Vector3d, kMaxJoints> force, moment;
  Eigen::Vector3d omega = Eigen::Vector3d::Zero(), alpha = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration = -gravity;
  for (int i = 0; i < n; ++i) {
    const JointGeometry& joint = chain.geometry[i];
    const Eigen::Vector3d axis = joint.axis;
    pose[i] = link_pose(chain, i, q[i]);
    const Eigen::Matrix3d to_link = pose[i].rotation.transpose();
    const Eigen::Vector3d& p = pose[i].position;
    acceleration = (to_link * (acceleration + alpha.cross(p) + omega.cross(omega.cross(p)))).eval();
    omega = (to_link * omega).eval();
    alpha = (to_link * alpha).eval();
    if (joint.kind == AxisKind::revolute) {
      alpha += axis * ddq[i] + omega.cross(axis) * dq[i];
      omega += axis * dq[i];
    } else {
      acceleration += axis * ddq[i] + 2.0 * omega.cross(axis) * dq[i];
    }
    const LinkInertia& link = chain.links[i];
    force[i] = acceleration * link.mass + alpha.cross(link.first_moment) +
               omega.cross(omega.cross(link.first_moment));
    moment[i] =
        link.inertia * alpha + omega.cross(link.inertia * omega) + link.first_moment.cross(acceleration);
  }
  JointVector tau(n);
  for (int i = n - 1; i >= 0; --i) {
    const JointGeometry& joint = chain.geometry[i];
    const Eigen::Vector3d axis = joint.axis;
    tau[i] = axis.dot(joint.kind == AxisKind::revolute ? moment[i] : force[i]);
    if (!chain.rotor_inertia.empty()) tau[i] += chain.rotor_inertia[i] * ddq[i];
    if (i == 0) break;
    const Eigen::Vector3d force_in_parent = pose[i].rotation * force[i];
    moment[i - 1] += pose[i].rotation * moment[i] + pose[i].position.cross(force_in_parent);
    force[i - 1] += force_in_parent;
  }
  if (!chain.shared_drives.empty()) add_shared_rotors(chain, ddq, tau);
  return tau;
}

JointVector friction_torque(const Chain& chain, const JointVector& dq) {
  using std::abs;
  JointVector torque(chain.joints());
  for (int i = 0; i < chain.joints(); ++i) {
    const Friction& f = chain.friction[i];
    torque[i] = f.viscous * dq[i] + f.coulomb * elementary::tanh(dq[i] / f.width) + f.offset +
                f.bend * elementary::tanh(dq[i] / f.bend_width) + f.skew * abs(dq[i]);
  }
  return torque;
}

JointVector inverse_dynamics(const Chain& chain, const JointVector& q, const JointVector& dq,
                             const JointVector& ddq) {
  JointVector tau = rigid_body_torque(chain, q, dq, ddq, chain.gravity);
  for (int i = 0; i < chain.joints(); ++i) tau[i] += load_friction(chain.friction[i], dq[i], tau[i]);
  tau += friction_torque(chain, dq);
  add_extra_torque(chain, q, dq, tau);
  return tau;
}

JointMatrix inertia_matrix(const Chain& chain, const JointVector& q) {
  const int n = chain.joints();
  std::array<LinkPose, kMaxJoints> pose;
  std::array<LinkInertia, kMaxJoints> composite;
  for (int i = 0; i < n; ++i) {
    pose[i] = link_pose(chain, i, q[i]);
    composite[i] = chain.links[i];
  }
  JointMatrix m(n, n);
  for (int i = n - 1; i >= 0; --i) {
    const LinkInertia& body = composite[i];
    const JointGeometry& joint = chain.geometry[i];
    const Eigen::Vector3d axis = joint.axis;
    Eigen::Vector3d force,
        moment;  // on the composite body at a unit acceleration of joint i; moment about its origin
    if (joint.kind == AxisKind::revolute) {
      force = axis.cross(body.first_moment);
      moment = body.inertia * axis;
    } else {
      force = axis * body.mass;
      moment = body.first_moment.cross(axis);
    }
    for (int k = i;; --k) {
      const JointGeometry& other = chain.geometry[k];
      const double entry = other.axis.dot(other.kind == AxisKind::revolute ? moment : force);
      m(i, k) = entry;
      m(k, i) = entry;
      if (k == 0) break;
      force = (pose[k].rotation * force).eval();
      moment = (pose[k].rotation * moment + pose[k].position.cross(force)).eval();
    }
    if (!chain.rotor_inertia.empty()) m(i, i) += chain.rotor_inertia[i];
    if (i == 0) break;
    const Eigen::Matrix3d& r = pose[i].rotation;
    const Eigen::Vector3d& p = pose[i].position;
    const Eigen::Vector3d h = r * body.first_moment;
    LinkInertia& parent = composite[i - 1];
    parent.inertia += r * body.inertia * r.transpose() +
                      (body.mass * p.squaredNorm() + 2.0 * p.dot(h)) * Eigen::Matrix3d::Identity() -
                      body.mass * p * p.transpose() - p * h.transpose() - h * p.transpose();
    parent.first_moment += h + body.mass * p;
    parent.mass += body.mass;
  }
  if (!chain.shared_drives.empty()) add_shared_rotors(chain, m);
  return m;
}

void add_extra_torque(const Chain& chain, const JointVector& q, const JointVector& dq, JointVector& torque) {
  for (const Ripple& r : chain.ripples) {
    const auto [s, c] = elementary::sin_cos(r.rate * q[r.joint.index()]);
    torque[r.joint.index()] += r.cosine * c + r.sine * s;
  }
  for (const SharedDrive& f : chain.shared_drives) {
    double speed = 0.0;
    for (int i = 0; i < chain.joints(); ++i) speed += f.along[i] * dq[i];
    const double drag = f.viscous * speed + f.coulomb * elementary::tanh(speed / f.width);
    for (int i = 0; i < chain.joints(); ++i) torque[i] += f.along[i] * drag;
  }
}

void add_shared_rotors(const Chain& chain, const JointVector& ddq, JointVector& torque) {
  for (const SharedDrive& drive : chain.shared_drives) {
    double rate = 0.0;
    for (int i = 0; i < chain.joints(); ++i) rate += drive.along[i] * ddq[i];
    for (int i = 0; i < chain.joints(); ++i) torque[i] += drive.along[i] * drive.rotor_inertia * rate;
  }
}

void add_shared_rotors(const Chain& chain, JointMatrix& inertia) {
  for (const SharedDrive& drive : chain.shared_drives)
    for (int i = 0; i < chain.joints(); ++i)
      for (int k = 0; k < chain.joints(); ++k)
        inertia(i, k) += drive.along[i] * drive.along[k] * drive.rotor_inertia;
}

double load_friction(const Friction& f, double dq, double carried) {
  using std::abs;
  return f.load == 0.0 ? 0.0 : f.load * abs(carried) * elementary::tanh(dq / f.width);
}

double carried_torque(double lost, double torque) {
  return torque / (torque > 0.0 ? 1.0 + lost : 1.0 - lost);
}

double carried_torque(const Friction& f, double dq, double torque) {
  if (f.load == 0.0) return torque;
  return carried_torque(f.load * elementary::tanh(dq / f.width), torque);
}

}  // namespace faultline
