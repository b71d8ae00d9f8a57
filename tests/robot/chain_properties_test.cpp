// SPDX-License-Identifier: MIT
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "lib/core/random.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/robot/robot.hpp"

/// Laws that hold for every chain, checked on chains with general bodies, offsets and any axes.
namespace faultline {
namespace {

using Vector = JointVector<double>;
using Matrix = JointMatrix<double>;

Vector draw(Random& random, int n, double scale) {
  Vector v(n);
  for (int i = 0; i < n; ++i) v[i] = random.uniform(-scale, scale);
  return v;
}

Eigen::Vector3d draw3(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

Chain<double> with_general_bodies(Chain<double> chain, Random& random) {
  for (int i = 0; i < chain.joints(); ++i) {
    Eigen::Matrix3d root;
    root << draw3(random), draw3(random), draw3(random);
    chain.links[i] =
        general_body(random.uniform(0.5, 2.0), 0.2 * draw3(random), 0.1 * root * root.transpose());
    chain.length[i] = random.uniform(0.2, 1.0);
    chain.rotor_inertia[i] = random.uniform(0.0, 0.1);
  }
  return chain;
}

/// Two revolute axes and a prismatic one that cross at right angles, as in the wrist of a surgical arm.
Chain<double> crossed_wrist(Random& random) {
  Chain<double> chain = with_general_bodies(preset_robot("RRP").chain, random);
  chain.geometry[1].axis = Eigen::Vector3d::UnitY();
  chain.geometry[1].direction.setZero();
  chain.geometry[1].offset = {0.0, 0.0, 0.3};
  chain.geometry[2].axis = Eigen::Vector3d::UnitX();
  chain.geometry[2].direction = Eigen::Vector3d::UnitX();
  return chain;
}

std::vector<Chain<double>> assorted_chains() {
  Random random(21);
  std::vector<Chain<double>> chains;
  for (const char* axes : {"RRP", "RRPR", "RPRR", "RR", "R", "P"})
    chains.push_back(with_general_bodies(preset_robot(axes).chain, random));
  chains.push_back(crossed_wrist(random));
  Chain<double> skew = with_general_bodies(preset_robot("RRPR").chain, random);
  for (JointGeometry& joint : skew.geometry) {
    joint.axis = draw3(random).normalized();
    joint.offset = 0.3 * draw3(random);
  }
  skew.gravity = 9.81 * draw3(random).normalized();
  chains.push_back(skew);
  return chains;
}

double energy(const Chain<double>& chain, const Vector& q, const Vector& dq) {
  return kinetic_energy(chain, q, dq) + potential_energy(chain, q);
}

void step_free(const Chain<double>& chain, Vector& q, Vector& dq, double h) {
  const Vector zero = Vector::Zero(chain.joints());
  const auto f = [&](const Vector& x, const Vector& v) {
    return Vector(forward_dynamics(chain, x, v, zero));
  };
  const Vector a1 = f(q, dq), v2 = dq + 0.5 * h * a1, a2 = f(q + 0.5 * h * dq, v2);
  const Vector v3 = dq + 0.5 * h * a2, a3 = f(q + 0.5 * h * v2, v3), v4 = dq + h * a3, a4 = f(q + h * v3, v4);
  q += h / 6.0 * (dq + 2.0 * v2 + 2.0 * v3 + v4);
  dq += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
}

TEST(ChainProperties, FreeMotionKeepsEnergy) {
  Random random(22);
  for (const Chain<double>& chain : assorted_chains()) {
    Vector q = draw(random, chain.joints(), 1.0), dq = draw(random, chain.joints(), 1.0);
    const double before = energy(chain, q, dq);
    const double scale = std::abs(kinetic_energy(chain, q, dq)) + 1.0;
    for (int k = 0; k < 1000; ++k) step_free(chain, q, dq, 5e-4);
    EXPECT_NEAR(energy(chain, q, dq), before, 1e-7 * scale);
  }
}

TEST(ChainProperties, FreeScaraKeepsMomentumAboutItsFirstAxis) {
  Random random(23);
  const Chain<double> chain = preset_robot("RRP").chain;
  Vector q = draw(random, 3, 1.0), dq = draw(random, 3, 2.0);
  const double first = momentum(chain, q, dq)[0], second = momentum(chain, q, dq)[1];
  for (int k = 0; k < 1000; ++k) step_free(chain, q, dq, 5e-4);
  EXPECT_NEAR(momentum(chain, q, dq)[0], first, 1e-10);
  EXPECT_GT(std::abs(momentum(chain, q, dq)[1] - second), 1e-3);  // joint 2 is not cyclic
}

TEST(ChainProperties, InertiaIsSymmetricPositiveDefinite) {
  Random random(24);
  for (const Chain<double>& chain : assorted_chains()) {
    for (int k = 0; k < 20; ++k) {
      const Matrix m = inertia_matrix(chain, draw(random, chain.joints(), 3.0));
      EXPECT_EQ((m - m.transpose()).cwiseAbs().maxCoeff(), 0.0);
      EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m).eigenvalues().minCoeff(), 1e-6);
    }
  }
}

/// dM/dq_k by central differences, for every k.
std::vector<Matrix> inertia_slopes(const Chain<double>& chain, const Vector& q) {
  std::vector<Matrix> slopes;
  for (int k = 0; k < chain.joints(); ++k) {
    Vector low = q, high = q;
    low[k] -= 1e-5;
    high[k] += 1e-5;
    slopes.push_back((inertia_matrix(chain, high) - inertia_matrix(chain, low)) / 2e-5);
  }
  return slopes;
}

/// Coriolis matrix from Christoffel symbols of the first kind.
Matrix christoffel_matrix(const std::vector<Matrix>& slopes, const Vector& dq) {
  const auto n = dq.size();
  Matrix c = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        c(i, j) += 0.5 * (slopes[k](i, j) + slopes[j](i, k) - slopes[i](j, k)) * dq[k];
  return c;
}

TEST(ChainProperties, MdotMinusTwoCIsSkewAndCdqIsTheBias) {
  Random random(25);
  for (const Chain<double>& chain : assorted_chains()) {
    const int n = chain.joints();
    const Vector q = draw(random, n, 2.0), dq = draw(random, n, 2.0);
    const auto slopes = inertia_slopes(chain, q);
    const Matrix c = christoffel_matrix(slopes, dq);
    // Mdot along the motion itself, not from the slopes C was built of.
    const double h = 1e-5;
    const Matrix mdot =
        (inertia_matrix(chain, Vector(q + h * dq)) - inertia_matrix(chain, Vector(q - h * dq))) / (2 * h);
    const Matrix s = mdot - 2.0 * c;
    EXPECT_LT((s + s.transpose()).cwiseAbs().maxCoeff(), 1e-6);
    const Vector coriolis = bias_torque(chain, q, dq) - gravity_torque(chain, q);
    EXPECT_LT((coriolis - c * dq).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_NEAR(dq.dot(mdot * dq) - 2.0 * dq.dot(coriolis), 0.0, 1e-6);  // power balance
  }
}

TEST(ChainProperties, ForwardUndoesInverse) {
  Random random(26);
  for (Chain<double> chain : assorted_chains()) {
    for (auto& f : chain.friction) f = {0.4, 0.7, 0.1, 0.05};
    const int n = chain.joints();
    const Vector q = draw(random, n, 2.0), dq = draw(random, n, 2.0), ddq = draw(random, n, 5.0);
    const Vector tau = inverse_dynamics(chain, q, dq, ddq);
    EXPECT_LT((forward_dynamics(chain, q, dq, tau) - ddq).norm(), 1e-9);
  }
}

TEST(ChainProperties, InverseEqualsEulerLagrangeOfTheEnergies) {
  Random random(27);
  for (const Chain<double>& chain : assorted_chains()) {
    const int n = chain.joints();
    const Vector q = draw(random, n, 1.5), dq = draw(random, n, 1.5), ddq = draw(random, n, 3.0);
    // d/dt (dL/d dq) - dL/dq along q(t) = q + dq t + ddq t^2 / 2, with p = M dq from the kinetic energy.
    const double h = 1e-5;
    const auto p_at = [&](double t) {
      return Vector(momentum(chain, Vector(q + t * dq + 0.5 * t * t * ddq), Vector(dq + t * ddq)));
    };
    const Vector dp = (p_at(h) - p_at(-h)) / (2 * h);
    const Vector tau = rigid_body_torque(chain, q, dq, ddq, chain.gravity);
    for (int k = 0; k < n; ++k) {
      Vector low = q, high = q;
      low[k] -= h;
      high[k] += h;
      const double lagrangian = (kinetic_energy(chain, high, dq) - potential_energy(chain, high) -
                                 kinetic_energy(chain, low, dq) + potential_energy(chain, low)) /
                                (2 * h);
      EXPECT_NEAR(tau[k], dp[k] - lagrangian, 1e-6) << "joint " << k + 1;
    }
  }
}

/// Kinetic energy from the speeds of the bodies' points, with no use of M: each link as the seven point
/// masses that have its mass, centre and inertia tensor.
double energy_of_points(const Chain<double>& chain, const Vector& q, const Vector& dq) {
  const double h = 1e-6;
  const auto places = [&](const Vector& at, int link, const Eigen::Vector3d& point) {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    for (int i = 0; i <= link; ++i) {
      const JointGeometry& joint = chain.geometry[i];
      Eigen::Vector3d offset = joint.offset;
      if (i > 0) offset += chain.length[i - 1] * joint.direction;
      if (joint.kind == AxisKind::prismatic) offset += at[i] * joint.axis;
      position += rotation * offset;
      if (joint.kind == AxisKind::revolute) rotation = rotation * Eigen::AngleAxisd(at[i], joint.axis);
    }
    return Eigen::Vector3d(position + rotation * point);
  };
  double total = 0.0;
  for (int i = 0; i < chain.joints(); ++i) {
    const LinkInertia<double>& link = chain.links[i];
    const Eigen::Vector3d centre = link.first_moment / link.mass;
    const Eigen::Matrix3d at_centre =
        link.inertia -
        link.mass * (centre.squaredNorm() * Eigen::Matrix3d::Identity() - centre * centre.transpose());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(
        0.5 * at_centre.trace() * Eigen::Matrix3d::Identity() - at_centre);
    const auto add = [&](double mass, const Eigen::Vector3d& point) {
      const Eigen::Vector3d v = (places(q + h * dq, i, point) - places(q - h * dq, i, point)) / (2 * h);
      total += 0.5 * mass * v.squaredNorm();
    };
    // Second moments along the principal directions, as pairs of points of mass m/6 (or with a sign, if need
    // be).
    const double share = link.mass / 6.0;
    for (int k = 0; k < 3; ++k) {
      const double second = principal.eigenvalues()[k];
      const double weight = second < 0.0 ? -share : share;
      const double arm = std::sqrt(std::abs(second) / (2.0 * share));
      add(weight, centre + arm * principal.eigenvectors().col(k));
      add(weight, centre - arm * principal.eigenvectors().col(k));
      add(2.0 * (share - weight), centre);
    }
    total += 0.5 * chain.rotor_inertia[i] * dq[i] * dq[i];
  }
  return total;
}

TEST(ChainProperties, KineticEnergyIsThatOfTheMovingPoints) {
  Random random(28);
  for (const Chain<double>& chain : assorted_chains()) {
    const Vector q = draw(random, chain.joints(), 2.0), dq = draw(random, chain.joints(), 2.0);
    const double expected = energy_of_points(chain, q, dq);
    EXPECT_NEAR(kinetic_energy(chain, q, dq), expected, 1e-6 * (1.0 + expected));
  }
}

TEST(ChainProperties, JetsGiveTheDerivativesOfDifferences) {
  using Jet = ceres::Jet<double, 3>;
  Random random(29);
  Chain<double> chain = crossed_wrist(random);
  for (auto& f : chain.friction) f = {0.4, 0.7, 0.1, 0.3};
  const Vector q = draw(random, 3, 1.0), dq = draw(random, 3, 1.0), tau = draw(random, 3, 5.0);
  const Chain<Jet> jets = cast_chain<Jet>(chain);
  JointVector<Jet> q_jet(3), dq_jet(3), tau_jet(3);
  for (int i = 0; i < 3; ++i) {
    q_jet[i] = Jet(q[i], i);
    dq_jet[i] = Jet(dq[i]);
    tau_jet[i] = Jet(tau[i]);
  }
  const auto ddq = forward_dynamics(jets, q_jet, dq_jet, tau_jet);
  for (int k = 0; k < 3; ++k) {
    Vector low = q, high = q;
    low[k] -= 1e-6;
    high[k] += 1e-6;
    const Vector slope =
        (forward_dynamics(chain, high, dq, tau) - forward_dynamics(chain, low, dq, tau)) / 2e-6;
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(ddq[i].v[k], slope[i], 1e-6 * (1.0 + std::abs(slope[i])));
  }
}

TEST(ChainProperties, JetsRunThroughTheParameters) {
  using Jet = ceres::Jet<double, 1>;
  const Robot robot = preset_robot("RRP");
  Chain<Jet> chain = cast_chain<Jet>(robot.chain);
  chain.links[2].mass = Jet(1.0, 0);
  JointVector<Jet> q(3), zero(3);
  q << Jet(0.1), Jet(0.2), Jet(-0.1);
  zero << Jet(0.0), Jet(0.0), Jet(0.0);
  EXPECT_NEAR(gravity_torque(chain, q)[2].v[0], 9.81, 1e-12);
  EXPECT_NEAR(inertia_matrix(chain, q)(2, 2).v[0], 1.0, 1e-12);
}

TEST(ChainProperties, VerticalRRIsTheTextbookDoublePendulum) {
  // Point masses at the ends of massless rods; angles from the downward vertical, q1 = theta1,
  // q2 = theta2 - theta1. (m1+m2) l1^2 th1'' + m2 l1 l2 cos(d) th2'' + m2 l1 l2 sin(d) th2'^2
  // + (m1+m2) g l1 sin th1 = 0 and m2 l2^2 th2'' + m2 l1 l2 cos(d) th1'' - m2 l1 l2 sin(d) th1'^2
  // + m2 g l2 sin th2 = 0, d = th1 - th2.
  const double m1 = 1.2, m2 = 0.7, l1 = 0.5, l2 = 0.4, g = 9.81;
  Robot robot = preset_robot("RR");
  robot.chain.gravity = {g, 0.0, 0.0};  // along x: links hang at q = 0
  robot.chain.length = {l1, l2};
  robot.chain.links[0] = general_body(m1, {l1, 0, 0}, Eigen::Matrix3d::Zero());
  robot.chain.links[1] = general_body(m2, {l2, 0, 0}, Eigen::Matrix3d::Zero());
  Random random(30);
  for (int k = 0; k < 20; ++k) {
    const Vector q = draw(random, 2, 3.0), dq = draw(random, 2, 3.0);
    const Vector ddq = forward_dynamics(robot.chain, q, dq, Vector(Vector::Zero(2)));
    const double th1 = q[0], th2 = q[0] + q[1], w1 = dq[0], w2 = dq[0] + dq[1];
    const double a1 = ddq[0], a2 = ddq[0] + ddq[1], c = std::cos(th1 - th2), s = std::sin(th1 - th2);
    EXPECT_NEAR(
        (m1 + m2) * l1 * l1 * a1 + m2 * l1 * l2 * (c * a2 + s * w2 * w2) + (m1 + m2) * g * l1 * std::sin(th1),
        0.0, 1e-9);
    EXPECT_NEAR(m2 * l2 * l2 * a2 + m2 * l1 * l2 * (c * a1 - s * w1 * w1) + m2 * g * l2 * std::sin(th2), 0.0,
                1e-9);
  }
}

TEST(ChainProperties, ScaraOrdersAgreeOnTheSameArm) {
  // An RRPR whose tool has no inertia about its axis besides its mass is the RRP; an RPRR with the lift first
  // carries the arm on the lift: its R joints feel what an RR arm feels, its P joint the weight of all.
  Random random(31);
  Robot rrp = preset_robot("RRP"), rrpr = preset_robot("RRPR");
  set_masses_and_lengths(rrp, {2.0, 1.5, 1.2}, {0.5, 0.4, 0.0});
  set_masses_and_lengths(rrpr, {2.0, 1.5, 0.7, 0.0}, {0.5, 0.4, 0.0, 0.0});
  rrpr.chain.links[3] = general_body(0.5, {0, 0, -0.1}, 1e-3 * Eigen::Matrix3d::Identity());
  const Vector q = draw(random, 4, 1.0), dq = draw(random, 4, 1.0), ddq = draw(random, 4, 2.0);
  const Vector three =
      inverse_dynamics(rrp.chain, Vector(q.head(3)), Vector(dq.head(3)), Vector(ddq.head(3)));
  const Vector four = inverse_dynamics(rrpr.chain, q, dq, ddq);
  const double tool = 1e-3 * (ddq[0] + ddq[1] + ddq[3]);
  EXPECT_NEAR(four[0], three[0] + tool, 1e-12);
  EXPECT_NEAR(four[1], three[1] + tool, 1e-12);
  EXPECT_NEAR(four[2], three[2], 1e-12);
  EXPECT_NEAR(four[3], tool, 1e-12);

  Robot rprr = preset_robot("RPRR");
  set_masses_and_lengths(rprr, {2.0, 1.0, 1.5, 0.5}, {0.3, 0.0, 0.5, 0.4});
  const Vector tau = inverse_dynamics(rprr.chain, q, dq, ddq);
  EXPECT_NEAR(tau[1], (1.0 + 1.5 + 0.5) * (ddq[1] + 9.81), 1e-12);
  Robot rr = preset_robot("RR");
  set_masses_and_lengths(rr, {1.5, 0.5}, {0.5, 0.4});
  Vector still_q(2), still_dq(2), still_ddq(2);
  still_q << q[2], q[3];
  still_dq << dq[2], dq[3];
  still_ddq << ddq[2], ddq[3];
  Vector calm_dq = dq, calm_ddq = ddq;
  calm_dq[0] = calm_ddq[0] = 0.0;
  const Vector arm = inverse_dynamics(rr.chain, still_q, still_dq, still_ddq);
  const Vector whole = inverse_dynamics(rprr.chain, q, calm_dq, calm_ddq);
  EXPECT_NEAR(whole[2], arm[0], 1e-12);
  EXPECT_NEAR(whole[3], arm[1], 1e-12);
}

TEST(ChainProperties, TipFollowsTheLinks) {
  Robot robot = preset_robot("RRP");
  set_masses_and_lengths(robot, {1, 1, 1}, {0.5, 0.4, 0.0});
  Vector q(3);
  q << 0.3, 0.4, -0.2;
  const auto tip = tip_position(robot.chain, q);
  EXPECT_NEAR(tip.x(), 0.5 * std::cos(0.3) + 0.4 * std::cos(0.7), 1e-15);
  EXPECT_NEAR(tip.z(), -0.2, 1e-15);
  Robot single = preset_robot("R");
  set_masses_and_lengths(single, {1}, {0.5});
  EXPECT_NEAR(tip_position(single.chain, Vector(q.head(1))).y(), 0.5 * std::sin(0.3), 1e-15);
}

}  // namespace
}  // namespace faultline
