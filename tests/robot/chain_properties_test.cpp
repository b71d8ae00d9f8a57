// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "lib/robot/dynamics.hpp"
#include "tests/robot/assorted_chains.hpp"
#include "tests/support/chain_mechanics.hpp"

/// Laws that hold for every chain, checked on chains with general bodies, offsets and any axes.
namespace faultline {
namespace {

using Vector = JointVector;
using Matrix = JointMatrix;

double energy(const Chain& chain, const Vector& q, const Vector& dq) {
  return kinetic_energy(chain, q, dq) + potential_energy(chain, q);
}

void step_free(const Chain& chain, Vector& q, Vector& dq, double h) {
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
  for (const Chain& chain : assorted_chains()) {
    Vector q = draw(random, chain.joints(), 1.0), dq = draw(random, chain.joints(), 1.0);
    const double before = energy(chain, q, dq);
    const double scale = std::abs(kinetic_energy(chain, q, dq)) + 1.0;
    for (int k = 0; k < 1000; ++k) step_free(chain, q, dq, 5e-4);
    EXPECT_NEAR(energy(chain, q, dq), before, 1e-7 * scale);
  }
}

TEST(ChainProperties, FreeScaraKeepsMomentumAboutItsFirstAxis) {
  Random random(23);
  const Chain chain = preset_robot("RRP").chain;
  Vector q = draw(random, 3, 1.0), dq = draw(random, 3, 2.0);
  const double first = momentum(chain, q, dq)[0], second = momentum(chain, q, dq)[1];
  for (int k = 0; k < 1000; ++k) step_free(chain, q, dq, 5e-4);
  EXPECT_NEAR(momentum(chain, q, dq)[0], first, 1e-10);
  EXPECT_GT(std::abs(momentum(chain, q, dq)[1] - second), 1e-3);  // joint 2 is not cyclic
}

TEST(ChainProperties, InertiaIsSymmetricPositiveDefinite) {
  Random random(24);
  for (const Chain& chain : assorted_chains()) {
    for (int k = 0; k < 20; ++k) {
      const Matrix m = inertia_matrix(chain, draw(random, chain.joints(), 3.0));
      EXPECT_EQ((m - m.transpose()).cwiseAbs().maxCoeff(), 0.0);
      EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m).eigenvalues().minCoeff(), 1e-6);
    }
  }
}

/// dM/dq_k by central differences, for every k.
std::vector<Matrix> inertia_slopes(const Chain& chain, const Vector& q) {
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
  for (const Chain& chain : assorted_chains()) {
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

TEST(ChainProperties, ForwardDynamicsUndoInverseDynamics) {
  Random random(26);
  for (Chain chain : assorted_chains()) {
    for (auto& f : chain.friction) f = {0.4, 0.7, 0.1, 0.05};
    const int n = chain.joints();
    const Vector q = draw(random, n, 2.0), dq = draw(random, n, 2.0), ddq = draw(random, n, 5.0);
    const Vector tau = inverse_dynamics(chain, q, dq, ddq);
    EXPECT_LT((forward_dynamics(chain, q, dq, tau) - ddq).norm(), 1e-9);
  }
}

TEST(ChainProperties, InverseDynamicsEqualEulerLagrangeOfTheEnergies) {
  Random random(27);
  for (const Chain& chain : assorted_chains()) {
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
double energy_of_points(const Chain& chain, const Vector& q, const Vector& dq) {
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
    const LinkInertia& link = chain.links[i];
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
  for (const Chain& chain : assorted_chains()) {
    const Vector q = draw(random, chain.joints(), 2.0), dq = draw(random, chain.joints(), 2.0);
    const double expected = energy_of_points(chain, q, dq);
    EXPECT_NEAR(kinetic_energy(chain, q, dq), expected, 1e-6 * (1.0 + expected));
  }
}

}  // namespace
}  // namespace faultline
