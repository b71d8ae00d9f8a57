// SPDX-License-Identifier: MIT
#include "lib/identify/feasible.hpp"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>

#include "lib/core/random.hpp"
#include "lib/identify/body_shape.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr int kProbes = 64;             // configurations at which the inertia matrix is looked at
constexpr double kDefinite = 1e-4;      // least eigenvalue of the inertia matrix scaled to a unit diagonal
constexpr double kFrictionDoubt = 4.0;  // standard deviations below zero that are no doubt any more
constexpr int kIterations = 500;
constexpr double kTolerance = 1e-12;  // the cost is far from round, so small steps are no end
constexpr double kRounding = 1e-9;    // kg or kg m^2: not negative

bool positive_definite(const Chain<double>& chain, const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
  Random random(11);
  for (int k = 0; k < kProbes; ++k) {
    JointVector<double> q(chain.joints());
    for (int j = 0; j < chain.joints(); ++j) q[j] = random.uniform(low[j], high[j]);
    const Eigen::MatrixXd m = inertia_matrix(chain, q);
    if (!m.allFinite() || !(m.diagonal().minCoeff() > 0.0)) return false;
    const Eigen::VectorXd scale = m.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * m * scale.asDiagonal(),
                                                               Eigen::EigenvaluesOnly);
    if (!(eigen.eigenvalues()[0] > kDefinite)) return false;
  }
  return true;
}

/// The bodies' free numbers, then square roots of the friction, offsets and timing, as parameters of the
/// space.
class FeasibleParameters {
 public:
  FeasibleParameters(const ParameterSpace& space, const Robot& robot)
      : space_(space), bodies_(robot), map_(base_map(space)) {}

  int count() const { return bodies_.count() + space_.linear() - space_.rigid(); }
  Eigen::VectorXd start(const Eigen::VectorXd& parameters) const {
    Eigen::VectorXd x(count());
    x.head(bodies_.count()) = bodies_.start();
    for (int p = space_.rigid(); p < space_.linear(); ++p)
      x[at(p)] = is_friction(p) ? std::sqrt(std::max(parameters[p], 0.0) + 1e-12) : parameters[p];
    return x;
  }
  /// All linear parameters.
  Eigen::VectorXd operator()(const Eigen::VectorXd& x) const {
    Eigen::VectorXd out(space_.linear());
    out.head(space_.rigid()) = map_ * bodies_.numbers(x.head(bodies_.count()));
    for (int p = space_.rigid(); p < space_.linear(); ++p)
      out[p] = is_friction(p) ? x[at(p)] * x[at(p)] : x[at(p)];
    return out;
  }
  int bodies() const { return bodies_.count(); }
  const Eigen::VectorXd& doubt() const { return bodies_.doubt(); }

 private:
  int at(int p) const { return bodies_.count() + p - space_.rigid(); }
  bool is_friction(int p) const { return p < space_.offset(0); }

  const ParameterSpace& space_;
  BodyNumbers bodies_;
  Eigen::MatrixXd map_;
};

/// Distance from the weighted system, and from what the robot file says where the system says nothing.
struct FeasibleCost {
  const FeasibleParameters& parameters;
  Eigen::MatrixXd factor;
  Eigen::VectorXd target, start, fixed;
  const std::vector<bool>& wanted;

  bool operator()(double const* const* x, double* residual) const {
    const Eigen::Map<const Eigen::VectorXd> at(x[0], parameters.count());
    Eigen::VectorXd linear = parameters(at);
    for (Eigen::Index p = 0; p < linear.size(); ++p)
      if (!wanted[p]) linear[p] = fixed[p];
    Eigen::Map<Eigen::VectorXd> r(residual, target.size() + parameters.bodies());
    r.head(target.size()) = factor * linear - target;
    r.tail(parameters.bodies()) = (at - start).head(parameters.bodies()).cwiseQuotient(parameters.doubt());
    return r.allFinite();
  }
};

}  // namespace

std::string infeasibility(const ParameterSpace& space, const Eigen::VectorXd& parameters,
                          const Eigen::MatrixXd& covariance, const Eigen::VectorXd& q_low,
                          const Eigen::VectorXd& q_high) {
  for (int p = 0; p < space.rigid(); ++p)
    if ((space.base[p].is_mass || space.base[p].is_rotor) && parameters[p] < -kRounding)
      return fmt::format("{} came out as {:.4g} {}", space.name(p), parameters[p], space.unit(p));
  for (int p = space.rigid(); p < space.offset(0); ++p)
    if (parameters[p] < -kFrictionDoubt * std::sqrt(covariance(p, p)))
      return fmt::format("{} came out as {:.4g} {}", space.name(p), parameters[p], space.unit(p));
  if (!positive_definite(chain_from(space, parameters), q_low, q_high))
    return "the inertia matrix was not positive definite over the range of the motion";
  return "";
}

Eigen::VectorXd nearest_feasible(const ParameterSpace& space, const Robot& robot, const WeakSystem& system,
                                 const WeakFit& fit, const std::vector<bool>& wanted) {
  const FeasibleParameters parameters(space, robot);
  const Eigen::VectorXd root = fit.weight.cwiseSqrt();
  Eigen::MatrixXd stacked(system.a.rows(), system.a.cols() + 1);
  stacked << root.asDiagonal() * system.a, root.cwiseProduct(system.y);
  const Eigen::Index count = system.a.cols();
  const Eigen::MatrixXd r =
      stacked.householderQr().matrixQR().topRows(count + 1).triangularView<Eigen::Upper>();
  const Eigen::VectorXd start = parameters.start(fit.parameters);
  auto* cost = new ceres::DynamicNumericDiffCostFunction<FeasibleCost>(new FeasibleCost{
      parameters, r.topLeftCorner(count, count), r.col(count).head(count), start, fit.parameters, wanted});
  cost->AddParameterBlock(parameters.count());
  cost->SetNumResiduals(static_cast<int>(count) + parameters.bodies());
  Eigen::VectorXd x = start;
  ceres::Problem problem;
  problem.AddResidualBlock(cost, nullptr, x.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = kIterations;
  options.function_tolerance = kTolerance;
  options.parameter_tolerance = kTolerance;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  Eigen::VectorXd out = fit.parameters;
  const Eigen::VectorXd linear = parameters(x);
  for (int p = 0; p < space.linear(); ++p)
    if (wanted[p]) out[p] = linear[p];
  return out;
}

}  // namespace faultline
