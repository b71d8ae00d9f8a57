// SPDX-License-Identifier: MIT
#include "lib/identify/parameter_space.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <cmath>

#include "lib/core/random.hpp"
#include "lib/identify/base_candidates.hpp"
#include "lib/robot/axis_units.hpp"

namespace faultline {
namespace {

constexpr double kRounding = 1e-12;  // kg m^2 or kg
constexpr int kProbes = 40;
constexpr double kIndependent = 1e-7;  ///< share of a column that the columns before it must leave

JointVector<double> draw(Random& random, int n, double scale) {
  JointVector<double> v(n);
  for (int i = 0; i < n; ++i) v[i] = random.uniform(-scale, scale);
  return v;
}

/// Torque of every inertial number and rotor at random states: (probes n) x (11 n).
Eigen::MatrixXd probe(const Chain<double>& chain) {
  const int n = chain.joints();
  Random random(20260101);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(kProbes * n, n * (kLinkParameters + 1));
  LinkRegressor y;
  for (int k = 0; k < kProbes; ++k) {
    const auto q = draw(random, n, 2.0), dq = draw(random, n, 2.0), ddq = draw(random, n, 5.0);
    torque_regressor(chain, q, dq, ddq, y);
    all.block(k * n, 0, n, n * kLinkParameters) = y;
    all.block(k * n, n * kLinkParameters, n, n).diagonal() = ddq;
  }
  return all;
}

/// Coefficients of `column` on the columns kept so far, and the share of it they leave.
double project(const Eigen::MatrixXd& kept, const Eigen::VectorXd& column, Eigen::VectorXd& coefficients) {
  coefficients.resize(kept.cols());
  if (kept.cols() == 0) return 1.0;
  coefficients = kept.colPivHouseholderQr().solve(column);
  return (column - kept * coefficients).norm() / column.norm();
}

void explain(ParameterSpace& space, const Eigen::VectorXd& coefficients, const std::string& name) {
  for (int k = 0; k < coefficients.size(); ++k) {
    if (std::abs(coefficients[k]) < 1e-9) continue;
    const double size = std::abs(coefficients[k]);
    const std::string factor = std::abs(size - 1.0) < 1e-9 ? "" : fmt::format("{:.4g} ", size);
    space.base[k].meaning += fmt::format(" {} {}{}", coefficients[k] > 0 ? "+" : "-", factor, name);
  }
}

}  // namespace

std::string ParameterSpace::name(int p) const {
  const int n = joints();
  if (p < rigid()) return base[p].name;
  if (p == timing()) return "phi";
  if (p > timing()) return fmt::format("width{}", p - timing());
  constexpr const char* kFriction[] = {"fv_", "fc_", "offset_", "fb_", "fs_"};
  return fmt::format("{}{}", kFriction[(p - rigid()) / n], (p - rigid()) % n + 1);
}

std::string ParameterSpace::unit(int p) const {
  if (p < rigid()) return base[p].unit;
  if (p == timing()) return "samples";
  const bool is_width = p > timing();
  const int joint = is_width ? p - timing() - 1 : (p - rigid()) % joints();
  const AxisKind axis = chain.geometry[joint].kind;
  if (is_width) return velocity_unit(axis);
  if (p < coulomb(0) || p >= skew(0)) return viscous_unit(axis);
  return torque_unit(axis);
}

ParameterSpace parameter_space(const Robot& robot) {
  ParameterSpace space;
  space.chain = robot.chain;
  space.chain.rotor_inertia.resize(robot.joints(), 0.0);
  const Eigen::MatrixXd all = probe(robot.chain);
  const auto list = base_candidates(robot);
  Eigen::MatrixXd kept(all.rows(), 0), lift(all.cols(), 0);
  std::vector<const BaseCandidate*> rejected;
  for (const BaseCandidate& c : list) {
    const Eigen::VectorXd column = all * c.direction;
    Eigen::VectorXd coefficients;
    if (column.norm() < 1e-9 * std::sqrt(static_cast<double>(column.size()))) continue;
    if (project(kept, column, coefficients) < kIndependent) {
      rejected.push_back(&c);
      continue;
    }
    kept.conservativeResize(Eigen::NoChange, kept.cols() + 1);
    lift.conservativeResize(Eigen::NoChange, lift.cols() + 1);
    kept.rightCols<1>() = column;
    lift.rightCols<1>() = c.direction;
    space.base.push_back(c.parameter);
    if (c.parameter.is_rotor) space.chain.rotor_inertia[c.parameter.joint] = 0.0;
  }
  space.lift = lift;
  if (is_scara(robot)) return space;
  for (const BaseCandidate* c : rejected) {
    Eigen::VectorXd coefficients;
    project(kept, all * c->direction, coefficients);
    explain(space, coefficients, c->parameter.name);
  }
  return space;
}

Chain<double> chain_from(const ParameterSpace& space, const Eigen::VectorXd& p) {
  Chain<double> chain = space.chain;
  const int n = chain.joints();
  const Eigen::VectorXd numbers = space.lift * p.head(space.rigid());
  for (int i = 0; i < n; ++i) {
    chain.links[i] = link_from(numbers.segment<kLinkParameters>(i * kLinkParameters));
    chain.rotor_inertia[i] += numbers[n * kLinkParameters + i];
    chain.friction[i] = {p[space.viscous(i)],
                         p[space.coulomb(i)],
                         p[space.offset(i)],
                         std::exp(p[space.log_width(i)]),
                         p[space.bend(i)],
                         p[space.skew(i)],
                         space.chain.friction[i].bend_width};
  }
  return chain;
}

Eigen::VectorXd parameters_of(const ParameterSpace& space, const Chain<double>& chain, double phi) {
  const int n = space.joints();
  Eigen::VectorXd numbers(n * (kLinkParameters + 1)), p(space.count());
  for (int i = 0; i < n; ++i) {
    numbers.segment<kLinkParameters>(i * kLinkParameters) = to_vector(chain.links[i]);
    const double rotor = chain.rotor_inertia.empty() ? 0.0 : chain.rotor_inertia[i];
    numbers[n * kLinkParameters + i] = rotor - space.chain.rotor_inertia[i];
  }
  const Eigen::VectorXd torque = probe(chain) * numbers;
  p.head(space.rigid()) = (probe(space.chain) * space.lift).colPivHouseholderQr().solve(torque);
  for (int k = 0; k < space.rigid(); ++k)  // solved for, so zero comes out as rounding
    if (space.base[k].is_rotor && std::abs(p[k]) < kRounding) p[k] = 0.0;
  for (int i = 0; i < n; ++i) {
    p[space.viscous(i)] = chain.friction[i].viscous;
    p[space.coulomb(i)] = chain.friction[i].coulomb;
    p[space.offset(i)] = chain.friction[i].offset;
    p[space.bend(i)] = chain.friction[i].bend;
    p[space.skew(i)] = chain.friction[i].skew;
    p[space.log_width(i)] = std::log(chain.friction[i].width);
  }
  p[space.timing()] = phi;
  return p;
}

Eigen::MatrixXd base_map(const ParameterSpace& space) {
  const Eigen::MatrixXd all = probe(space.chain);
  return (all * space.lift).colPivHouseholderQr().solve(all);
}

}  // namespace faultline
