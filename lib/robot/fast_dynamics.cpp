// SPDX-License-Identifier: MIT
#include "lib/robot/fast_dynamics.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

/// tanh to 1e-16 absolute, about twice as fast as libm's.
double fast_tanh(double x) { return 1.0 - 2.0 / (elementary::exp(2.0 * x) + 1.0); }

/// Calls visit(k, c, s) for each revolute body k before body i, from the nearest one to the base; c and s are
/// cosine and sine of theta_i - theta_k.
template <typename Visit>
void for_bodies_before(int i, const FastDynamics::Pose& pose, const Visit& visit) {
  if (i == 0) return;
  double s = pose.sine[i], c = pose.cosine[i];
  for (int k = i - 1;; --k) {
    visit(k, c, s);
    if (k == 0) return;
    const double c_next = c * pose.cosine[k] - s * pose.sine[k];
    s = s * pose.cosine[k] + c * pose.sine[k];
    c = c_next;
  }
}

constexpr double kParallel = 1e-13;

bool has_parallel_axes(const Chain& chain) {
  const Eigen::Vector3d& normal = chain.geometry[0].axis;
  for (const JointGeometry& joint : chain.geometry)
    if (joint.axis.cross(normal).norm() > kParallel) return false;
  return true;
}

/// The bodies that turn rigidly with a revolute joint, projected along the normal, about that joint.
struct PlanarBody {
  double mass = 0.0;
  Eigen::Vector2d first_moment = Eigen::Vector2d::Zero();
  double inertia = 0.0;
  Eigen::Vector2d reach = Eigen::Vector2d::Zero();  ///< vector to the next revolute joint
};

}  // namespace

FastDynamics::FastDynamics(const Chain& chain) : chain_(chain), joints_(chain.joints()) {
  for (const auto& f : chain_.friction)
    has_friction_ = has_friction_ || f.viscous != 0.0 || f.coulomb != 0.0 || f.offset != 0.0 ||
                    f.bend != 0.0 || f.skew != 0.0;
  has_extra_ = !chain_.ripples.empty() || !chain_.shared_drives.empty();
  for (const auto& f : chain_.friction) has_extra_ = has_extra_ || f.load != 0.0;
  if (chain_.rotor_inertia.empty()) chain_.rotor_inertia.assign(joints_, 0.0);
  planar_ = joints_ > 0 && has_parallel_axes(chain_);
  if (planar_)
    set_up_planar(chain_.geometry[0].axis);
  else
    spatial_ = SpatialDynamics(chain_);
}

void FastDynamics::set_up_planar(const Eigen::Vector3d& normal) {
  Eigen::Matrix<double, 2, 3> plane;
  const Eigen::Vector3d u = normal.unitOrthogonal();
  plane << u.transpose(), normal.cross(u).transpose();
  PerJoint<PlanarBody> bodies{};
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  // origin of the link's frame on its planar body
  for (int i = 0; i < joints_; ++i) {
    const JointGeometry& joint = chain_.geometry[i];
    sign_[i] = joint.axis.dot(normal) > 0.0 ? 1.0 : -1.0;
    Eigen::Vector3d offset = joint.offset;
    if (i > 0) offset += chain_.length[i - 1] * joint.direction;
    place += plane * offset;
    if (joint.kind == AxisKind::revolute) {
      if (revolute_ > 0) bodies[revolute_ - 1].reach = place;
      revolute_joint_[revolute_++] = i;
      place.setZero();
    } else {
      prismatic_joint_[prismatic_++] = i;
    }
    if (revolute_ == 0) continue;
    const LinkInertia& link = chain_.links[i];
    const Eigen::Vector2d moment = plane * link.first_moment;
    PlanarBody& body = bodies[revolute_ - 1];
    body.mass += link.mass;
    body.first_moment += moment + link.mass * place;
    body.inertia +=
        normal.dot(link.inertia * normal) + 2.0 * place.dot(moment) + link.mass * place.squaredNorm();
  }
  std::copy_n(chain_.rotor_inertia.begin(), joints_, bodies_.rotor_inertia.begin());
  double carried = 0.0;
  for (int i = joints_ - 1; i >= 0; --i) {
    carried += chain_.links[i].mass;
    bodies_.carried_mass[i] = carried;
    bodies_.weight[i] = -sign_[i] * normal.dot(chain_.gravity) * carried;
  }
  const Eigen::Vector2d g = plane * chain_.gravity;
  gravity_in_plane_ = g.norm() > 1e-14 * chain_.gravity.norm();
  double beyond = 0.0;
  for (int j = revolute_ - 1; j >= 0; --j) {
    const Eigen::Vector2d s = bodies[j].first_moment + beyond * bodies[j].reach;
    bodies_.diagonal[j] = bodies[j].inertia + beyond * bodies[j].reach.squaredNorm();
    bodies_.gravity[j] = {g.x() * s.y() - g.y() * s.x(), g.x() * s.x() + g.y() * s.y()};
    for (int i = 0; i < j; ++i) {
      const Eigen::Vector2d& d = bodies[i].reach;
      bodies_.pairs[i][j] = {d.dot(s), d.y() * s.x() - d.x() * s.y()};
    }
    beyond += bodies[j].mass;
  }
}

void FastDynamics::planar_inertia_and_bias(const JointVector& q, const JointVector& dq, JointMatrix& inertia,
                                           JointVector& bias) const {
  inertia.setZero(joints_, joints_);
  bias.resize(joints_);
  const Pose at = pose(q);
  PerJoint<PerJoint<double>> a;  // A_ij
  PerJoint<double> rate, torque;
  double w = 0.0;
  for (int i = 0; i < revolute_; ++i) {
    w += sign_[revolute_joint_[i]] * dq[revolute_joint_[i]];
    rate[i] = w;
    torque[i] = gravity_on(i, at);
    a[i][i] = bodies_.diagonal[i];
    for_bodies_before(i, at, [&](int k, double c, double s) {
      const Pair& pair = bodies_.pairs[k][i];
      a[k][i] = pair.alpha * c + pair.beta * s;
      const double slope = pair.beta * c - pair.alpha * s;
      torque[k] += slope * rate[i] * rate[i];
      torque[i] -= slope * rate[k] * rate[k];
    });
  }
  // Converts absolute link angles to joint angles: entry (i, j) sums all bodies at or beyond both joints.
  PerJoint<double> column{};  // sum over l >= j of A_kl, for each k
  double collected = 0.0;
  for (int j = revolute_ - 1; j >= 0; --j) {
    const int joint = revolute_joint_[j];
    collected += torque[j];
    bias[joint] = sign_[joint] * collected;
    double sum = 0.0;
    for (int k = revolute_ - 1; k >= 0; --k) {
      column[k] += k <= j ? a[k][j] : a[j][k];
      sum += column[k];
      if (k > j) continue;
      const int other = revolute_joint_[k];
      inertia(joint, other) = inertia(other, joint) = sign_[joint] * sign_[other] * sum;
    }
  }
  for (int i = 0; i < prismatic_; ++i) {
    const int joint = prismatic_joint_[i];
    bias[joint] = bodies_.weight[joint];
    for (int k = 0; k <= i; ++k) {
      const int other = prismatic_joint_[k];
      inertia(joint, other) = inertia(other, joint) =
          sign_[joint] * sign_[other] * bodies_.carried_mass[joint];
    }
  }
  for (int i = 0; i < joints_; ++i) inertia(i, i) += bodies_.rotor_inertia[i];
}

double FastDynamics::gravity_on(int i, const Pose& pose) const {
  if (!gravity_in_plane_) return 0.0;
  return bodies_.gravity[i].alpha * pose.along[i] + bodies_.gravity[i].beta * pose.up[i];
}

void FastDynamics::add_slides_and_rotors(const JointVector& motion, JointVector& sum) const {
  for (int i = 0; i < prismatic_; ++i) {
    const int joint = prismatic_joint_[i];
    for (int k = 0; k < prismatic_; ++k) {
      const int other = prismatic_joint_[k];
      sum[joint] += sign_[joint] * sign_[other] * bodies_.carried_mass[prismatic_joint_[std::max(i, k)]] *
                    motion[other];
    }
  }
  for (int i = 0; i < joints_; ++i) sum[i] += bodies_.rotor_inertia[i] * motion[i];
}

void FastDynamics::momentum_and_force(const JointVector& q, const JointVector& dq, JointVector& momentum,
                                      JointVector& force) const {
  if (!planar_) return spatial_.momentum_and_force(q, dq, momentum, force);
  momentum.setZero(joints_);
  force.resize(joints_);
  const Pose at = pose(q);
  PerJoint<double> rate, of_body, push;  // of each revolute body, in absolute angles
  double w = 0.0;
  for (int i = 0; i < revolute_; ++i) {
    w += sign_[revolute_joint_[i]] * dq[revolute_joint_[i]];
    rate[i] = w;
    of_body[i] = bodies_.diagonal[i] * w;
    push[i] = -gravity_on(i, at);
    for_bodies_before(i, at, [&](int k, double c, double s) {
      const Pair& pair = bodies_.pairs[k][i];
      const double a = pair.alpha * c + pair.beta * s;
      const double slope = (pair.beta * c - pair.alpha * s) * rate[i] * rate[k];
      of_body[k] += a * rate[i];
      of_body[i] += a * rate[k];
      push[k] -= slope;
      push[i] += slope;
    });
  }
  double p = 0.0, f = 0.0;  // momentum and force of all bodies at or beyond a joint
  for (int j = revolute_ - 1; j >= 0; --j) {
    const int joint = revolute_joint_[j];
    momentum[joint] = sign_[joint] * (p += of_body[j]);
    force[joint] = sign_[joint] * (f += push[j]);
  }
  for (int i = 0; i < prismatic_; ++i) force[prismatic_joint_[i]] = -bodies_.weight[prismatic_joint_[i]];
  add_slides_and_rotors(dq, momentum);
}

void FastDynamics::inertia_and_bias(const JointVector& q, const JointVector& dq, JointMatrix& inertia,
                                    JointVector& bias) const {
  if (planar_)
    planar_inertia_and_bias(q, dq, inertia, bias);
  else
    spatial_.inertia_and_bias(q, dq, inertia, bias);
  if (!chain_.shared_drives.empty()) add_shared_rotors(chain_, inertia);
}

FastDynamics::Pose FastDynamics::pose(const JointVector& q) const {
  Pose out;
  double theta = 0.0;
  for (int i = 0; i < revolute_; ++i) {
    const double angle = sign_[revolute_joint_[i]] * q[revolute_joint_[i]];
    if (gravity_in_plane_) {
      const auto [up, along] = elementary::sin_cos(theta += angle);
      out.up[i] = up;
      out.along[i] = along;
    }
    if (i == 0) continue;
    const auto [sine, cosine] = elementary::sin_cos(angle);
    out.sine[i] = sine;
    out.cosine[i] = cosine;
  }
  return out;
}

JointVector FastDynamics::planar_torque(const Pose& pose, const JointVector& dq,
                                        const JointVector& ddq) const {
  PerJoint<double> square, turn, torque;  // of each revolute body: squared rate, acceleration
  double rate = 0.0, sum = 0.0;
  for (int i = 0; i < revolute_; ++i) {
    const int joint = revolute_joint_[i];
    rate += sign_[joint] * dq[joint];
    square[i] = rate * rate;
    turn[i] = sum += sign_[joint] * ddq[joint];
    torque[i] = bodies_.diagonal[i] * turn[i] + gravity_on(i, pose);
    for_bodies_before(i, pose, [&](int k, double c, double s) {
      const Pair& pair = bodies_.pairs[k][i];
      const double a = pair.alpha * c + pair.beta * s, slope = pair.beta * c - pair.alpha * s;
      torque[k] += a * turn[i] + slope * square[i];
      torque[i] += a * turn[k] - slope * square[k];
    });
  }
  JointVector out(joints_);
  double collected = 0.0;  // torque on all bodies at or beyond a joint
  for (int j = revolute_ - 1; j >= 0; --j) {
    const int joint = revolute_joint_[j];
    out[joint] = sign_[joint] * (collected += torque[j]);
  }
  for (int i = 0; i < prismatic_; ++i) out[prismatic_joint_[i]] = bodies_.weight[prismatic_joint_[i]];
  add_slides_and_rotors(ddq, out);
  return out;
}

JointVector FastDynamics::body_torque(const JointVector& q, const JointVector& dq,
                                      const JointVector& ddq) const {
  if (planar_ && chain_.shared_drives.empty()) return planar_torque(pose(q), dq, ddq);
  JointMatrix inertia;
  JointVector bias;
  inertia_and_bias(q, dq, inertia, bias);
  bias.noalias() += inertia.lazyProduct(ddq);
  return bias;
}

void FastDynamics::friction(const JointVector& dq, JointVector& torque) const {
  torque.resize(joints_);
  if (!has_friction_) {
    torque.setZero();
    return;
  }
  for (int i = 0; i < joints_; ++i) {
    const Friction& f = chain_.friction[i];
    torque[i] = f.viscous * dq[i] + f.offset;
    if (f.coulomb != 0.0) torque[i] += f.coulomb * fast_tanh(dq[i] / f.width);
    if (f.bend != 0.0) torque[i] += f.bend * fast_tanh(dq[i] / f.bend_width);
    if (f.skew != 0.0) torque[i] += f.skew * std::abs(dq[i]);
  }
}

void FastDynamics::drag(const JointVector& q, const JointVector& dq, const JointVector& tau,
                        JointVector& torque) const {
  friction(dq, torque);
  if (!has_extra_) return;
  add_extra_torque(chain_, q, dq, torque);
  for (int i = 0; i < joints_; ++i)
    torque[i] = tau[i] - carried_torque(chain_.friction[i], dq[i], tau[i] - torque[i]);
}

FastDynamics::BodiesAt FastDynamics::bodies_at(const JointVector& q, const JointVector& dq,
                                               unsigned locked) const {
  BodiesAt out;
  inertia_and_bias(q, dq, out.factor, out.bias);
  factor_small(joints_, out.factor.data(), locked);
  out.locked = locked;
  return out;
}

void FastDynamics::acceleration(const BodiesAt& bodies, const JointVector& q, const JointVector& dq,
                                const JointVector& tau, JointVector& ddq) const {
  JointVector lost;
  drag(q, dq, tau, lost);
  ddq.resize(joints_);
  for (int i = 0; i < joints_; ++i) ddq[i] = tau[i] - bodies.bias[i] - lost[i];
  solve_factored(joints_, bodies.factor.data(), ddq.data(), bodies.locked);
}

void factor_small(int n, double* a, unsigned fixed) {
  for (int j = 0; j < n; ++j) {
    if (fixed >> j & 1u) {
      for (int i = 0; i < n; ++i) a[i * n + j] = a[j * n + i] = 0.0;
      a[j * n + j] = 1.0;
    }
  }
  for (int j = 0; j < n; ++j) {  // the unit lower factor times D in the columns, D on the diagonal
    const double inverse = 1.0 / a[j * n + j];
    for (int i = j + 1; i < n; ++i) {
      const double factor = a[j * n + i] * inverse;
      if (factor == 0.0) continue;
      for (int k = i; k < n; ++k) a[i * n + k] -= factor * a[j * n + k];
    }
  }
}

void solve_factored(int n, const double* a, double* b, unsigned fixed) {
  for (int j = 0; j < n; ++j)
    if (fixed >> j & 1u) b[j] = 0.0;
  for (int j = 0; j < n; ++j) {
    const double inverse = 1.0 / a[j * n + j];
    for (int i = j + 1; i < n; ++i) b[i] -= a[j * n + i] * inverse * b[j];
  }
  for (int j = n - 1; j >= 0; --j) {
    double sum = b[j];
    for (int i = j + 1; i < n; ++i) sum -= a[j * n + i] * b[i];
    b[j] = sum / a[j * n + j];
  }
}

}  // namespace faultline
