// SPDX-License-Identifier: MIT
#include "lib/robot/payload.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/random.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr int kStates = 6;            // random states in which the torques of payloads are compared
constexpr double kOnePayload = 1e-9;  // 1 - cosine between torques below which two payloads count as one
constexpr double kUnfelt_Nm = 1e-9;   // largest torque of 1 kg that is not identifiable

/// Returns the torques that 1 kg at the end of a link takes in kStates states, one state after the other.
Eigen::VectorXd torques_of_payload(const Chain& chain, int link) {
  const int n = chain.joints();
  Chain alone = chain;
  for (LinkInertia& body : alone.links) body = {};
  alone.rotor_inertia.assign(static_cast<std::size_t>(n), 0.0);
  alone = with_payload(alone, link, 1.0);
  Random random(1);
  Eigen::VectorXd out(kStates * n);
  JointVector q(n), dq(n), ddq(n);
  for (int k = 0; k < kStates; ++k) {
    for (int i = 0; i < n; ++i) {
      q[i] = random.uniform(-2.0, 2.0);
      dq[i] = random.uniform(-2.0, 2.0);
      ddq[i] = random.uniform(-5.0, 5.0);
    }
    out.segment(k * n, n) = rigid_body_torque(alone, q, dq, ddq, alone.gravity);
  }
  return out;
}

bool are_one(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return std::abs(a.dot(b)) >= (1.0 - kOnePayload) * a.norm() * b.norm();
}

}  // namespace

Eigen::Vector3d link_end(const Chain& chain, int link) {
  const JointGeometry& joint = chain.geometry[link];
  if (link + 1 < chain.joints()) {
    const JointGeometry& next = chain.geometry[link + 1];
    return next.offset + chain.length[link] * next.direction;
  }
  if (joint.kind == AxisKind::prismatic) return Eigen::Vector3d::Zero();
  return chain.length[link] *
         (joint.direction.isZero() ? Eigen::Vector3d(Eigen::Vector3d::UnitX()) : joint.direction);
}

Chain with_payload(const Chain& chain, int link, double kg) {
  Chain loaded = chain;
  const LinkInertia body = general_body(kg, link_end(chain, link), Eigen::Matrix3d::Zero());
  LinkInertia& carrier = loaded.links[link];
  carrier.mass += body.mass;
  carrier.first_moment += body.first_moment;
  carrier.inertia += body.inertia;
  return loaded;
}

std::vector<Joint> payload_links(const Chain& chain) {
  std::vector<Joint> out;
  std::vector<Eigen::VectorXd> later;
  for (int link = chain.joints() - 1; link >= 0; --link) {
    Eigen::VectorXd torque = torques_of_payload(chain, link);
    if (torque.cwiseAbs().maxCoeff() < kUnfelt_Nm) continue;
    if (std::any_of(later.begin(), later.end(), [&](const auto& other) { return are_one(torque, other); }))
      continue;
    later.push_back(std::move(torque));
    out.push_back(Joint::at(link));
  }
  std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace faultline
