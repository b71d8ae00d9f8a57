// SPDX-License-Identifier: MIT
#include "lib/identify/feasible/feasible.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "lib/balance/regressor.hpp"
#include "lib/core/matrix/decompositions.hpp"
#include "lib/core/random.hpp"
#include "lib/identify/feasible/definite_least_squares.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr int kProbes = 64;              // positions at which the inertia matrix is checked
constexpr double kDefinite = 1e-4;       // least eigenvalue of the inertia matrix scaled to a unit diagonal
constexpr double kInfeasibleStds = 4.0;  // standard deviations: friction farther below zero is infeasible
constexpr double kPrior = 0.01;  // weight of the robot's own bodies, against residuals in standard deviations
constexpr double kLeastFriction = 1e-6;       // N m s/rad, N m, N s/m or N
constexpr double kFeasibleLeastScale = 1e-4;  // least scale of the robot file's bodies: they stay positive
constexpr double kRounding = 1e-9;            // kg or kg m^2: a value this little below 0 is not negative

constexpr double kLeastMass = 1e-3;     // kg, if the robot file has none
constexpr double kLeastInertia = 1e-5;  // kg m^2
constexpr double kLeastSpread = 0.05;   // m: least radius of gyration, if the robot file has none

/// A feasible body or rotor: `numbers` times its unknowns are its inertial numbers if its block is positive
/// definite. The block of a rod is [inertia, first moment; first moment, mass], of a point its mass, of a
/// general link its pseudo-inertia (Wensing, Kim and Slotine 2018), of a rotor its inertia.
struct Body {
  Eigen::MatrixXd numbers;
  DefiniteBlock block;
  int first_number = 0;  ///< index of its first one among the numbers of links and rotors (11 n)
};

/// Returns second moments, first moment and mass as one matrix (4 x 4).
Eigen::MatrixXd pseudo_inertia(const LinkInertia& link) {
  Eigen::Matrix4d j;
  j.topLeftCorner<3, 3>() = 0.5 * link.inertia.trace() * Eigen::Matrix3d::Identity() - link.inertia;
  j.topRightCorner<3, 1>() = link.first_moment;
  j.bottomLeftCorner<1, 3>() = link.first_moment.transpose();
  j(3, 3) = link.mass;
  return j;
}

double mass_of(const LinkInertia& link) { return std::max(link.mass, kLeastMass); }

Body general_body_of(const LinkInertia& link) {
  Body body;
  body.numbers = Eigen::MatrixXd::Identity(kLinkParameters, kLinkParameters);
  for (int k = 0; k < kLinkParameters; ++k)
    body.block.basis.push_back(pseudo_inertia(link_from(LinkVector::Unit(k))));
  const double mass = mass_of(link), least = mass * kLeastSpread * kLeastSpread + kLeastInertia;
  const Eigen::Vector3d centre = link.first_moment / mass;
  const Eigen::Matrix3d about =
      pseudo_inertia(link).topLeftCorner<3, 3>() - mass * centre * centre.transpose();
  const Eigen::Matrix3d second =
      Eigen::Matrix3d(about.diagonal().cwiseMax(least).asDiagonal()) + mass * centre * centre.transpose();
  body.block.nominal =
      to_vector({mass, link.first_moment, second.trace() * Eigen::Matrix3d::Identity() - second});
  return body;
}

/// Returns a rod: mass, first moment along the link and inertia about every axis across it.
Body rod_of(const LinkInertia& link, const Eigen::Vector3d& along) {
  Body body;
  LinkInertia mass, moment, inertia;
  mass.mass = 1.0;
  moment.first_moment = along;
  inertia.inertia = Eigen::Matrix3d::Identity() - along * along.transpose();
  body.numbers.resize(kLinkParameters, 3);
  body.numbers << to_vector(mass), to_vector(moment), to_vector(inertia);
  const Eigen::Matrix2d of_mass{{0.0, 0.0}, {0.0, 1.0}}, of_moment{{0.0, 1.0}, {1.0, 0.0}},
      of_inertia{{1.0, 0.0}, {0.0, 0.0}};
  body.block.basis = {of_mass, of_moment, of_inertia};
  const double m = mass_of(link), centre = link.first_moment.dot(along) / m;
  const double origin = 0.5 * (link.inertia.trace() - along.dot(link.inertia * along));
  const double about =
      std::max(origin - m * centre * centre, m * kLeastSpread * kLeastSpread + kLeastInertia);
  body.block.nominal = Eigen::Vector3d(m, m * centre, about + m * centre * centre);
  return body;
}

/// Returns the block of one number, unknown `first`, that must be positive.
DefiniteBlock positive_number(int first, double nominal) {
  return {first, {Eigen::MatrixXd::Ones(1, 1)}, Eigen::VectorXd::Constant(1, nominal)};
}

Body point_of(const LinkInertia& link) {
  Body body;
  body.numbers = to_vector(point_mass(1.0));
  body.block = positive_number(0, mass_of(link));
  return body;
}

Body body_of(const Robot& robot, int i) {
  const LinkInertia& link = robot.chain.links[i];
  switch (robot.shapes[i]) {
    case LinkShape::rod:
      return rod_of(link, link_direction(robot, i));
    case LinkShape::point:
      return point_of(link);
    case LinkShape::general:
      break;
  }
  return general_body_of(link);
}

/// Returns the bodies of a robot with these link shapes, then its rotors.
std::vector<Body> bodies_of(const Robot& robot) {
  const int n = robot.joints();
  std::vector<Body> out;
  for (int i = 0; i < n; ++i) {
    out.push_back(body_of(robot, i));
    out.back().first_number = i * kLinkParameters;
  }
  for (int i = 0; i < n; ++i) {
    const double rotor = robot.chain.rotor_inertia.empty() ? 0.0 : robot.chain.rotor_inertia[i];
    out.push_back({Eigen::MatrixXd::Ones(1, 1), positive_number(0, std::max(rotor, kLeastInertia)),
                   n * kLinkParameters + i});
  }
  return out;
}

/// Unknowns of nearest_feasible: bodies and rotors, then the wanted ones of friction, offsets and timing.
struct FeasibleUnknowns {
  int bodies = 0;              ///< number of unknowns of bodies and rotors
  Eigen::MatrixXd parameters;  ///< linear parameters x unknowns
  std::vector<DefiniteBlock> blocks;
};

FeasibleUnknowns feasible_unknowns(const ParameterSpace& space, const Robot& robot, const WeakFit& fit,
                                   const std::vector<bool>& wanted) {
  FeasibleUnknowns out;
  Eigen::MatrixXd numbers(robot.joints() * (kLinkParameters + 1), 0);
  for (const Body& body : bodies_of(robot)) {
    out.blocks.push_back(body.block);
    out.blocks.back().first = out.bodies;
    out.bodies += body.block.unknowns();
    numbers.conservativeResize(Eigen::NoChange, out.bodies);
    numbers.rightCols(body.block.unknowns()).setZero();
    numbers.block(body.first_number, out.blocks.back().first, body.numbers.rows(), body.numbers.cols()) =
        body.numbers;
  }
  std::vector<int> others;
  for (int p = space.rigid(); p < space.linear(); ++p)
    if (wanted[p]) others.push_back(p);
  out.parameters.setZero(space.linear(), out.bodies + static_cast<int>(others.size()));
  out.parameters.topLeftCorner(space.rigid(), out.bodies) = base_map(space) * numbers;
  for (std::size_t i = 0; i < others.size(); ++i) {
    const int p = others[i], at = out.bodies + static_cast<int>(i);
    out.parameters(p, at) = 1.0;
    if (p >= space.offset(0)) continue;
    const double size =
        std::max({std::abs(fit.parameters[p]), std::sqrt(fit.covariance(p, p)), kLeastFriction});
    out.blocks.push_back(positive_number(at, size));
  }
  for (int p = 0; p < space.rigid(); ++p)
    if (!wanted[p]) out.parameters.row(p).setZero();
  return out;
}

/// Scales the mass of the robot's own bodies by the one factor that fits the torques best.
void scale_bodies(const Eigen::MatrixXd& a, const Eigen::VectorXd& y, FeasibleUnknowns& unknowns) {
  Eigen::VectorXd nominal = Eigen::VectorXd::Zero(unknowns.bodies);
  for (const DefiniteBlock& block : unknowns.blocks)
    if (block.first < unknowns.bodies) nominal.segment(block.first, block.unknowns()) = block.nominal;
  Eigen::MatrixXd few(a.rows(), 1 + a.cols() - unknowns.bodies);
  few << a.leftCols(unknowns.bodies) * nominal, a.rightCols(few.cols() - 1);
  const double factor = least_squares(few, y)[0];
  if (!std::isfinite(factor)) return;
  for (DefiniteBlock& block : unknowns.blocks)
    if (block.first < unknowns.bodies)
      block.nominal *= std::clamp(factor, kFeasibleLeastScale, 1.0 / kFeasibleLeastScale);
}

}  // namespace

bool has_definite_inertia(const Chain& chain, const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
  Random random(11);
  for (int k = 0; k < kProbes; ++k) {
    JointVector q(chain.joints());
    for (int j = 0; j < chain.joints(); ++j) q[j] = random.uniform(low[j], high[j]);
    const Eigen::MatrixXd m = inertia_matrix(chain, q);
    if (!m.allFinite() || !(m.diagonal().minCoeff() > 0.0)) return false;
    const Eigen::VectorXd scale = m.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::VectorXd values = symmetric_eigenvalues(scale.asDiagonal() * m * scale.asDiagonal());
    if (!(values[0] > kDefinite)) return false;
  }
  return true;
}

std::string infeasibility(const ParameterSpace& space, const Eigen::VectorXd& parameters,
                          const Eigen::MatrixXd& covariance, const Eigen::VectorXd& q_low,
                          const Eigen::VectorXd& q_high) {
  for (int p = 0; p < space.offset(0); ++p) {
    const bool is_rigid = p < space.rigid();
    if (is_rigid && !space.base[p].is_mass && !space.base[p].is_rotor) continue;
    if (parameters[p] < (is_rigid ? -kRounding : -kInfeasibleStds * std::sqrt(covariance(p, p))))
      return fmt::format("{} was estimated as {:.4g} {}", space.name(p), parameters[p], space.unit(p));
  }
  if (!has_definite_inertia(chain_from(space, parameters), q_low, q_high))
    return "the inertia matrix was not positive definite over the range of the motion";
  return "";
}

Eigen::VectorXd nearest_feasible(const ParameterSpace& space, const Robot& robot, const WeakSystem& system,
                                 const WeakFit& fit, const std::vector<bool>& wanted) {
  FeasibleUnknowns unknowns = feasible_unknowns(space, robot, fit, wanted);
  const Eigen::VectorXd root = fit.weight.cwiseSqrt();
  Eigen::VectorXd known = fit.parameters.head(space.linear());
  for (int p = 0; p < space.linear(); ++p)
    if (wanted[p]) known[p] = 0.0;
  Eigen::MatrixXd stacked(system.a.rows(), unknowns.parameters.cols() + 1);
  stacked << root.asDiagonal() * (system.a * unknowns.parameters),
      root.cwiseProduct(system.y - system.a * known);
  const Eigen::Index count = unknowns.parameters.cols();
  const Eigen::MatrixXd r =
      stacked.householderQr().matrixQR().topRows(count + 1).triangularView<Eigen::Upper>();
  const Eigen::MatrixXd a = r.topLeftCorner(count, count);
  const Eigen::VectorXd y = r.col(count).head(count);
  scale_bodies(a, y, unknowns);
  const Eigen::VectorXd x = definite_least_squares(a, y, unknowns.blocks, kPrior);
  const Eigen::VectorXd linear = unknowns.parameters * x;
  Eigen::VectorXd out = fit.parameters;
  for (int p = 0; p < space.linear(); ++p)
    if (wanted[p]) out[p] = linear[p];
  return out;
}

}  // namespace faultline
