// SPDX-License-Identifier: MIT
#include "lib/identify/feasible/feasible.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "lib/core/matrix/decompositions.hpp"
#include "lib/core/random.hpp"
#include "lib/identify/feasible/body_shape.hpp"
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

bool positive_definite(const Chain& chain, const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
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

/// Unknowns of nearest_feasible: bodies and rotors, then the wanted ones of friction, offsets and timing.
struct FeasibleUnknowns {
  int bodies = 0;              ///< number of unknowns of bodies and rotors
  Eigen::MatrixXd parameters;  ///< linear parameters x unknowns
  std::vector<DefiniteBlock> blocks;
};

FeasibleUnknowns feasible_unknowns(const ParameterSpace& space, const Robot& robot, const WeakFit& fit,
                                   const std::vector<bool>& wanted) {
  const BodyShapes shapes = body_shapes(robot);
  std::vector<int> others;
  for (int p = space.rigid(); p < space.linear(); ++p)
    if (wanted[p]) others.push_back(p);
  FeasibleUnknowns out;
  out.bodies = shapes.unknowns();
  out.blocks = shapes.blocks;
  out.parameters.setZero(space.linear(), shapes.unknowns() + static_cast<int>(others.size()));
  out.parameters.topLeftCorner(space.rigid(), shapes.unknowns()) = base_map(space) * shapes.numbers;
  for (std::size_t i = 0; i < others.size(); ++i) {
    const int p = others[i], at = shapes.unknowns() + static_cast<int>(i);
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

std::string infeasibility(const ParameterSpace& space, const Eigen::VectorXd& parameters,
                          const Eigen::MatrixXd& covariance, const Eigen::VectorXd& q_low,
                          const Eigen::VectorXd& q_high) {
  for (int p = 0; p < space.rigid(); ++p)
    if ((space.base[p].is_mass || space.base[p].is_rotor) && parameters[p] < -kRounding)
      return fmt::format("{} was estimated as {:.4g} {}", space.name(p), parameters[p], space.unit(p));
  for (int p = space.rigid(); p < space.offset(0); ++p)
    if (parameters[p] < -kInfeasibleStds * std::sqrt(covariance(p, p)))
      return fmt::format("{} was estimated as {:.4g} {}", space.name(p), parameters[p], space.unit(p));
  if (!positive_definite(chain_from(space, parameters), q_low, q_high))
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
