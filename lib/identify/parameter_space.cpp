// SPDX-License-Identifier: MIT
#include "lib/identify/parameter_space.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/matrix/decompositions.hpp"
#include "lib/core/random.hpp"
#include "lib/robot/chain.hpp"
#include "lib/robot/payload.hpp"

namespace faultline {
namespace {

constexpr double kSpaceRounding = 1e-12;  // kg m^2 or kg
constexpr int kSpaceProbes = 40;          // random states: far more rows than the 11 columns per joint
constexpr double kIndependent = 1e-7;     ///< least share of a column independent of those before it

/// A direction in which the links' inertial numbers may change.
struct BaseCandidate {
  BaseParameter parameter;
  Eigen::VectorXd direction;  ///< 11 n: the links' numbers, then the rotors' inertia
};

BaseCandidate candidate(const std::string& name, const std::string& unit, int joints) {
  return {{name, unit, name}, Eigen::VectorXd::Zero(joints * (kLinkParameters + 1))};
}

LinkVector rod_inertia(const Eigen::Vector3d& direction) {
  LinkInertia link;
  link.inertia = Eigen::Matrix3d::Identity() - direction * direction.transpose();
  return to_vector(link);
}

/// Adds the inertial numbers of link i that its shape leaves free, those that carry most first.
void add_link_candidates(const Robot& robot, int i, std::vector<BaseCandidate>& out) {
  const int n = robot.joints(), at = i * kLinkParameters;
  const auto add = [&](const std::string& name, const std::string& unit, const LinkVector& v) {
    out.push_back(candidate(fmt::format("{}{}", name, Joint::at(i)), unit, n));
    out.back().direction.segment<kLinkParameters>(at) = v;
  };
  const auto unit_vector = [](int k) { return LinkVector(LinkVector::Unit(k)); };
  if (robot.shapes[i] == LinkShape::rod) {
    const Eigen::Vector3d along = link_direction(robot, i);
    LinkVector moment = LinkVector::Zero();
    moment.segment<3>(1) = along;
    add("I", "kg m^2", rod_inertia(along));
    add("mx", "kg m", moment);
  } else if (robot.shapes[i] == LinkShape::general) {
    const char* const inertia[] = {"Izz", "Ixx", "Iyy", "Ixy", "Ixz", "Iyz"};
    const int index[] = {6, 4, 5, 7, 8, 9};
    for (int k = 0; k < 6; ++k) add(inertia[k], "kg m^2", unit_vector(index[k]));
    add("mx", "kg m", unit_vector(1));
    add("my", "kg m", unit_vector(2));
    add("mz", "kg m", unit_vector(3));
  }
  add("m", "kg", unit_vector(0));
  out.back().parameter.is_mass = true;
}

/// Adds the rotor of joint i, which acts on its own joint alone.
void add_rotor_candidate(const Robot& robot, int i, std::vector<BaseCandidate>& out) {
  const bool turns = robot.chain.geometry[i].kind == AxisKind::revolute;
  BaseCandidate c = candidate(fmt::format("jr{}", Joint::at(i)), turns ? "kg m^2" : "kg", robot.joints());
  c.parameter.is_rotor = true;
  c.direction[robot.joints() * kLinkParameters + i] = 1.0;
  c.parameter.joint = Joint::at(i);
  out.push_back(std::move(c));
}

/// Returns a, b, c, m3 of the SCARA: each direction changes that one number of M and G and no other.
std::vector<BaseCandidate> scara_candidates(const Robot& robot) {
  const int n = robot.joints();
  const double l1 = robot.chain.length[0], l2 = robot.chain.length[1];
  const Eigen::Vector3d x1 = link_direction(robot, 0), x2 = link_direction(robot, 1);
  const bool tool = n > 3;
  const std::string carried = tool ? "(m3 + m4)" : "m3";
  BaseCandidate a = candidate("a", "kg m^2", n), b = candidate("b", "kg m^2", n),
                c = candidate("c", "kg m^2", n);
  BaseCandidate m = candidate("m3", "kg", n);
  a.parameter.meaning = fmt::format("l1^2 (m1/3 + m2 + {})", carried);
  b.parameter.meaning = fmt::format("l2^2 (m2/3 + {})", carried);
  c.parameter.meaning = fmt::format("l1 l2 (m2/2 + {})", carried);
  m.parameter.meaning = tool ? "m3 + m4" : "m3";
  m.parameter.is_mass = true;
  a.direction.segment<kLinkParameters>(0) = rod_inertia(x1);
  b.direction.segment<kLinkParameters>(kLinkParameters) = rod_inertia(x2);
  c.direction.segment<3>(kLinkParameters + 1) = x2 / l1;
  m.direction[2 * kLinkParameters] = 1.0;
  m.direction -= l1 * l1 * a.direction + l2 * l2 * b.direction + l1 * l2 * c.direction;
  return {a, b, c, m};
}

/// Whether the robot's base parameters are a, b, c and m3 of the SCARA.
bool is_scara(const Robot& robot) { return robot.axes == "RRP" || robot.axes == "RRPR"; }

/// Returns every change that the robot's link shapes allow, the preferred ones first: those whose torques
/// depend on the torques of earlier ones are no base parameters.
std::vector<BaseCandidate> base_candidates(const Robot& robot) {
  std::vector<BaseCandidate> out;
  if (is_scara(robot) && robot.chain.length[0] > 0.0 && robot.chain.length[1] > 0.0)
    out = scara_candidates(robot);
  for (int i = 0; i < robot.joints(); ++i) add_link_candidates(robot, i, out);
  for (int i = 0; i < robot.joints(); ++i)
    if (robot.known.count(fmt::format("jr{}", Joint::at(i))) == 0) add_rotor_candidate(robot, i, out);
  return out;
}

JointVector draw(Random& random, int n, double scale) {
  JointVector v(n);
  for (int i = 0; i < n; ++i) v[i] = random.uniform(-scale, scale);
  return v;
}

/// Returns the inertial numbers of the links, and 0 for the rotors: 11 n.
Eigen::VectorXd link_numbers(const Chain& chain) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(chain.joints() * (kLinkParameters + 1));
  for (int i = 0; i < chain.joints(); ++i)
    out.segment<kLinkParameters>(i * kLinkParameters) = to_vector(chain.links[i]);
  return out;
}

/// Returns the torque of every inertial number and rotor at random states: (probes n) x (11 n).
Eigen::MatrixXd probe(const Chain& chain) {
  const int n = chain.joints();
  Random random(20260101);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(kSpaceProbes * n, n * (kLinkParameters + 1));
  LinkRegressor y;
  for (int k = 0; k < kSpaceProbes; ++k) {
    const auto q = draw(random, n, 2.0), dq = draw(random, n, 2.0), ddq = draw(random, n, 5.0);
    torque_regressor(chain, q, dq, ddq, y);
    all.block(k * n, 0, n, n * kLinkParameters) = y;
    all.block(k * n, n * kLinkParameters, n, n).diagonal() = ddq;
  }
  return all;
}

/// Computes the coefficients of `column` on the columns kept so far; returns the share of it that is left.
double project(const Eigen::MatrixXd& kept, const Eigen::VectorXd& column, Eigen::VectorXd& coefficients) {
  coefficients.resize(kept.cols());
  if (kept.cols() == 0) return 1.0;
  coefficients = least_squares(kept, column);
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

/// Returns a name such as "rc_1_100": the cosine of joint 1's ripple of rate 100 1/rad.
std::string extra_name(const ParameterSpace& space, const ExtraTerm& term) {
  static constexpr std::array kNames{"fl", "jr", "fv", "fc", "rc", "rs", "gc"};
  static_assert(kNames.size() == static_cast<std::size_t>(ExtraKind::gear_compliance) + 1);
  std::string name = fmt::format("{}_", kNames[static_cast<std::size_t>(term.kind)]);
  if (is_of_shared_drive(term.kind)) {
    const Eigen::VectorXd& along = space.chain.shared_drives[term.index].along;
    for (int j = 0; j < space.joints(); ++j)
      if (along[j] != 0.0) name += fmt::format("{}{}", along[j] > 0.0 ? "+" : "-", Joint::at(j));
    return name;
  }
  name += fmt::format("{}", term.joint);
  return is_ripple(term.kind) ? fmt::format("{}_{:.5g}", name, space.chain.ripples[term.index].rate) : name;
}

std::string extra_unit(ExtraKind kind, AxisKind axis) {
  const bool turns = axis == AxisKind::revolute;
  if (kind == ExtraKind::load_friction) return "1";
  if (kind == ExtraKind::shared_inertia) return turns ? "kg m^2" : "kg";
  if (kind == ExtraKind::shared_viscous) return viscous_unit(axis);
  if (kind == ExtraKind::gear_compliance) return turns ? "rad/(N m)" : "m/N";
  return torque_unit(axis);
}

}  // namespace

Joint ParameterSpace::joint_of(int p) const {
  if (p < rigid()) return base[p].joint;
  if (p < extra_begin()) return Joint::at((p - rigid()) % joints());
  if (p < timing()) return extra_at(p).joint;
  return p == timing() ? 1_joint : Joint::at(p - timing() - 1);
}

std::string ParameterSpace::name(int p) const {
  if (p < rigid()) return base[p].name;
  if (is_extra(p)) return extra_name(*this, extra_at(p));
  if (p == timing()) return "phi";
  if (p > timing()) return fmt::format("width{}", joint_of(p));
  constexpr const char* kFriction[] = {"fv_", "fc_", "offset_", "fb_", "fs_"};
  return fmt::format("{}{}", kFriction[(p - rigid()) / joints()], joint_of(p));
}

std::string ParameterSpace::unit(int p) const {
  if (p < rigid()) return base[p].unit;
  if (p == timing()) return "samples";
  const AxisKind axis = chain.geometry[joint_of(p).index()].kind;
  if (p > timing()) return velocity_unit(axis);
  if (is_extra(p)) return extra_unit(extra_at(p).kind, axis);
  if (p < coulomb(0) || p >= skew(0)) return viscous_unit(axis);
  return torque_unit(axis);
}

ParameterSpace parameter_space(const Robot& robot) {
  ParameterSpace space;
  space.chain = robot.chain;
  space.chain.rotor_inertia.resize(robot.joints(), 0.0);
  space.extra = extra_terms_of(robot.chain, robot.gear_compliance);
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
    if (c.parameter.is_rotor) space.chain.rotor_inertia[c.parameter.joint.index()] = 0.0;
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

Chain chain_from(const ParameterSpace& space, const Eigen::VectorXd& p) {
  Chain chain = space.chain;
  const int n = chain.joints();
  const Eigen::VectorXd numbers = space.lift * p.head(space.rigid());
  for (int i = 0; i < n; ++i) {
    chain.links[i] = link_from(numbers.segment<kLinkParameters>(i * kLinkParameters));
    chain.rotor_inertia[i] += numbers[n * kLinkParameters + i];
    chain.friction[i] = {p[space.viscous(i)],
                         p[space.coulomb(i)],
                         p[space.offset(i)],
                         elementary::exp(p[space.log_width(i)]),
                         p[space.bend(i)],
                         p[space.skew(i)],
                         space.chain.friction[i].bend_width};
  }
  for (int k = space.extra_begin(); k < space.timing(); ++k)
    if (double* const value = extra_value(chain, space.extra_at(k))) *value = p[k];
  return chain;
}

Eigen::VectorXd parameters_of(const ParameterSpace& space, Chain chain, double phi) {
  const int n = space.joints();
  Eigen::VectorXd numbers = link_numbers(chain), p(space.count());
  for (int i = 0; i < n; ++i) {
    const double rotor = chain.rotor_inertia.empty() ? 0.0 : chain.rotor_inertia[i];
    numbers[n * kLinkParameters + i] = rotor - space.chain.rotor_inertia[i];
  }
  const Eigen::VectorXd torque = probe(chain) * numbers;
  p.head(space.rigid()) = least_squares(probe(space.chain) * space.lift, torque);
  for (int k = 0; k < space.rigid(); ++k)  // a least-squares solution, so zero comes out as rounding
    if (space.base[k].is_rotor && std::abs(p[k]) < kSpaceRounding) p[k] = 0.0;
  for (int i = 0; i < n; ++i) {
    p[space.viscous(i)] = chain.friction[i].viscous;
    p[space.coulomb(i)] = chain.friction[i].coulomb;
    p[space.offset(i)] = chain.friction[i].offset;
    p[space.bend(i)] = chain.friction[i].bend;
    p[space.skew(i)] = chain.friction[i].skew;
    p[space.log_width(i)] = elementary::log(chain.friction[i].width);
  }
  for (int k = space.extra_begin(); k < space.timing(); ++k) {
    const double* const value = extra_value(chain, space.extra_at(k));
    p[k] = value != nullptr ? *value : 0.0;
  }
  p[space.timing()] = phi;
  return p;
}

Eigen::MatrixXd base_map(const ParameterSpace& space) {
  const Eigen::MatrixXd all = probe(space.chain);
  return (all * space.lift).colPivHouseholderQr().solve(all);
}

bool has_joint(const std::vector<Joint>& joints, Joint joint) {
  return std::find(joints.begin(), joints.end(), joint) != joints.end();
}

double largest_alike(const ParameterSpace& space, const Eigen::VectorXd& values, int j) {
  double largest = 0.0;
  for (int i = 0; i < space.joints(); ++i)
    if (space.chain.geometry[i].kind == space.chain.geometry[j].kind) largest = std::max(largest, values[i]);
  return largest;
}

bool is_given_exactly(const ParameterSpace& space, const Robot& robot, int p) {
  std::string name = space.name(p);
  std::erase(name, '_');
  if (name.rfind("offset", 0) == 0) name.replace(0, 6, "fo");
  const auto it = robot.known.find(name);
  return p >= space.rigid() && it != robot.known.end() && it->second.std == 0.0;
}

WantedParameters wanted_parameters(const ParameterSpace& space, const Robot& robot,
                                   const std::vector<Joint>& still, bool try_offsets) {
  WantedParameters wanted{std::vector<bool>(space.count(), true), std::vector<bool>(space.count(), false)};
  for (int p = 0; p < space.rigid(); ++p) wanted.optional[p] = space.base[p].is_rotor;
  for (int p = space.rigid(); p < space.timing(); ++p) {
    wanted.optional[p] = p >= space.offset(0);
    wanted.asked[p] = (try_offsets || !wanted.optional[p] || space.is_extra(p)) &&
                      !has_joint(still, space.joint_of(p)) && !is_given_exactly(space, robot, p);
  }
  wanted.asked[space.timing()] = robot.log.torque_between_samples == TorqueTiming::unknown;
  return wanted;
}

Eigen::MatrixXd payload_columns(const ParameterSpace& space) {
  const int n = space.joints();
  const Eigen::MatrixXd map = base_map(space);
  Eigen::MatrixXd out(space.rigid(), n);
  for (int link = 0; link < n; ++link) {
    Chain chain = space.chain;
    for (LinkInertia& l : chain.links) l = {};
    out.col(link) = map * link_numbers(with_payload(chain, link, 1.0));
  }
  return out;
}

}  // namespace faultline
