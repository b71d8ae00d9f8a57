// SPDX-License-Identifier: MIT
#include "lib/identify/physical_equations.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <utility>

#include "lib/core/elementary/elementary.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

/// Adds `mass` at the end of the last link.
void load_tip(const Robot& robot, Chain& chain, double mass) {
  const int last = chain.joints() - 1;
  const Eigen::Vector3d tip = chain.length[last] * link_direction(robot, last);
  const LinkInertia body = general_body(mass, tip, Eigen::Matrix3d::Zero());
  chain.links[last].mass += body.mass;
  chain.links[last].first_moment += body.first_moment;
  chain.links[last].inertia += body.inertia;
}

}  // namespace

PhysicalEquations::PhysicalEquations(const Robot& robot, const ParameterSpace& space,
                                     std::span<const BaseEstimate> groups)
    : robot_(robot), space_(space) {
  list_unknowns(groups);
  for (const BaseEstimate& group : groups) add_group(group);
}

void PhysicalEquations::list_unknowns(std::span<const BaseEstimate> groups) {
  for (const char kind : {'m', 'l'})
    for (int i = 0; i < robot_.joints(); ++i) {
      if (kind == 'l' && robot_.shapes[i] != LinkShape::rod) continue;
      PhysicalUnknown u{fmt::format("{}{}", kind, Joint::at(i)), kind, i, 1.0, 0.0, false};
      if (const auto it = robot_.known.find(u.name); it != robot_.known.end()) {
        u.value = it->second.value;
        u.std = it->second.std;
        u.exact = u.std == 0.0;
      }
      unknowns_.push_back(u);
    }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const KnownValue& payload = groups[g].payload;
    if (payload.value != 0.0)
      unknowns_.push_back(
          {"payload", 'p', static_cast<int>(g), payload.value, payload.std, payload.std == 0.0});
  }
  std::copy_if(unknowns_.begin(), unknowns_.end(), std::back_inserter(open_),
               [](const PhysicalUnknown& u) { return !u.exact; });
}

bool PhysicalEquations::belongs_to_general_link(int p) const {
  const std::string& name = space_.base[p].name;
  if (!std::isdigit(static_cast<unsigned char>(name.back())) || space_.base[p].is_mass) return false;
  return robot_.shapes[name.back() - '1'] == LinkShape::general;
}

void PhysicalEquations::add_group(const BaseEstimate& from) {
  Group group;
  for (int p = 0; p < space_.rigid(); ++p)
    if (from.usable[p] && std::isfinite(from.estimate[p]) && std::isfinite(from.covariance(p, p)) &&
        !space_.base[p].is_rotor && !belongs_to_general_link(p))
      group.parameters.push_back(p);
  const auto m = static_cast<Eigen::Index>(group.parameters.size());
  group.target.resize(m);
  Eigen::MatrixXd c(m, m);
  for (Eigen::Index i = 0; i < m; ++i) {
    group.target[i] = from.estimate[group.parameters[i]];
    for (Eigen::Index k = 0; k < m; ++k) c(i, k) = from.covariance(group.parameters[i], group.parameters[k]);
  }
  for (Eigen::Index i = 0; i < m; ++i) c(i, i) += 1e-18 * (1.0 + group.target[i] * group.target[i]);
  group.whitener = Eigen::MatrixXd::Identity(m, m);
  if (m > 0) c.llt().matrixL().solveInPlace(group.whitener);
  groups_.push_back(std::move(group));
}

int PhysicalEquations::rows() const {
  Eigen::Index count = 0;
  for (const Group& group : groups_) count += group.target.size();
  return static_cast<int>(count);
}

double PhysicalEquations::scale() const {
  double largest = 0.0;
  for (const Group& group : groups_)
    if (group.target.size() > 0) largest = std::max(largest, group.target.cwiseAbs().maxCoeff());
  return largest;
}

Eigen::VectorXd PhysicalEquations::base(const Eigen::VectorXd& log_open, int group, double more) const {
  Robot robot = robot_;
  Eigen::Index next = 0;
  double payload = more;
  std::vector<double> mass(robot.joints(), 0.0), length = robot.chain.length;
  for (const PhysicalUnknown& u : unknowns_) {
    const double value = u.exact ? u.value : elementary::exp(log_open[next++]);
    if (u.kind == 'p') {
      if (u.index == group) payload += value;
      continue;
    }
    (u.kind == 'm' ? mass : length)[u.index] = value;
    if (robot.shapes[u.index] == LinkShape::general) set_parameter(robot, u.name, value);
  }
  robot = with_masses_and_lengths(std::move(robot), mass, length);
  if (payload != 0.0) load_tip(robot, robot.chain, payload);
  const Eigen::VectorXd all = parameters_of(space_, robot.chain, 0.0);
  const std::vector<int>& wanted = groups_[group].parameters;
  Eigen::VectorXd out(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) out[i] = all[wanted[i]];
  return out;
}

Eigen::MatrixXd PhysicalEquations::slopes(const Eigen::VectorXd& x, int group, double more) const {
  constexpr double kStep = 1e-5;  // of a logarithm, for central differences: near the cube root of rounding
  Eigen::MatrixXd j(groups_[group].target.size(), x.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    Eigen::VectorXd up = x, down = x;
    up[k] += kStep;
    down[k] -= kStep;
    j.col(k) = (base(up, group, more) - base(down, group, more)) / (2.0 * kStep);
  }
  return j;
}

Eigen::MatrixXd PhysicalEquations::relative_slopes(const Eigen::VectorXd& x, int group, double more) const {
  const Eigen::VectorXd at = base(x, group, more);
  if (at.size() == 0) return Eigen::MatrixXd::Zero(0, x.size());
  const double least = 1e-9 + 1e-6 * at.cwiseAbs().maxCoeff();
  return at.cwiseAbs().cwiseMax(least).cwiseInverse().asDiagonal() * slopes(x, group, more);
}

Eigen::MatrixXd PhysicalEquations::relative_slopes(const Eigen::VectorXd& x) const {
  Eigen::MatrixXd out(rows(), x.size());
  Eigen::Index at = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Eigen::MatrixXd part = relative_slopes(x, static_cast<int>(g), 0.0);
    out.middleRows(at, part.rows()) = part;
    at += part.rows();
  }
  return out;
}

void PhysicalEquations::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* j) const {
  const int m = rows();
  r.setZero(m + x.size());
  if (j) j->setZero(m + x.size(), x.size());
  Eigen::Index at = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Group& group = groups_[g];
    const Eigen::Index count = group.target.size();
    r.segment(at, count) = group.whitener * (base(x, static_cast<int>(g), 0.0) - group.target);
    if (j) j->middleRows(at, count) = group.whitener * slopes(x, static_cast<int>(g), 0.0);
    at += count;
  }
  for (std::size_t k = 0; k < open_.size(); ++k) {
    const PhysicalUnknown& u = open_[k];
    if (u.std <= 0.0) continue;
    r[m + k] = (elementary::exp(x[k]) - u.value) / u.std;
    if (j) (*j)(m + k, k) = elementary::exp(x[k]) / u.std;
  }
}

}  // namespace faultline
