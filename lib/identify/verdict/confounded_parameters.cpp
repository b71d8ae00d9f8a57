// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "lib/core/matrix/decompositions.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/identify/torque_fit.hpp"
#include "lib/identify/verdict/fit_verdict.hpp"
#include "lib/identify/weak_form/chooser.hpp"
#include "lib/identify/weak_form/weak_form.hpp"

namespace faultline {
namespace {

constexpr double kFrictionAlone = 0.95;  // of the explained torque: more shows that the joint is undriven
constexpr double kOtherwise = 0.2;       // of a parameter: the driven joints give another value,
constexpr double kOtherwiseStd = 3;      // by so many standard deviations

/// Returns, of the torque that the model explains of each joint, the share that its own friction explains.
Eigen::VectorXd friction_share(const ParameterSpace& space, const TorqueFit& torque) {
  const WeakSystem& s = torque.system;
  Eigen::VectorXd share = Eigen::VectorXd::Zero(space.joints());
  for (int j = 0; j < space.joints(); ++j) {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index k = 0; k < s.y.size(); ++k)
      if (s.joint[k] == j && s.use[k] > 0.0) rows.push_back(k);
    if (rows.empty()) continue;
    const std::vector<int> own{space.viscous(j), space.coulomb(j), space.offset(j)};
    const Eigen::MatrixXd a = s.a(rows, own);
    const Eigen::VectorXd y = s.y(rows), left = y - a * least_squares(a, y);
    const double all = y.squaredNorm(), explained = all - torque.fit.residual(rows).squaredNorm();
    if (explained > 0.0) share[j] = (all - left.squaredNorm()) / explained;
  }
  return share;
}

/// Returns the base parameters of undriven joints to which the driven joints alone give another value.
std::vector<bool> undriven_parameters(const ParameterSpace& space, const std::vector<Joint>& undriven,
                                      const TorqueFit& torque) {
  std::vector<bool> out(space.rigid(), false);
  if (undriven.empty()) return out;
  WeakSystem driven = torque.system;
  std::vector<bool> felt(space.rigid(), false);
  for (Eigen::Index k = 0; k < driven.y.size(); ++k) {
    if (!has_joint(undriven, Joint::at(driven.joint[k]))) continue;
    for (int p = 0; p < space.rigid(); ++p) felt[p] = felt[p] || driven.a(k, p) != 0.0;
    driven.use[k] = 0.0;
  }
  const WeakFit alone = fit_weak_form(driven, space, torque.fit.parameters, torque.wanted);
  for (int p = 0; p < space.rigid(); ++p) {
    if (!felt[p] || !torque.fit.free[p] || !alone.free[p] || alone.confounded[p]) continue;
    const double apart = std::abs(alone.parameters[p] - torque.fit.parameters[p]);
    const double size = std::max(std::abs(alone.parameters[p]), std::abs(torque.fit.parameters[p]));
    const double std = std::sqrt(alone.covariance(p, p) + torque.fit.covariance(p, p));
    out[p] = apart > kOtherwise * size && apart > kOtherwiseStd * std;
  }
  return out;
}

/// Returns `confounded` with the rotors, and the masses beside them, that would be mixed with an excluded
/// friction offset.
Confounded with_offsets(const ParameterSpace& space, const Robot& robot, const TorqueFit& torque,
                        std::vector<bool> confounded) {
  Confounded out{std::move(confounded), {}};
  const Eigen::MatrixXd a = torque.fit.weight.cwiseSqrt().asDiagonal() * torque.system.a;
  for (int rotor = 0; rotor < space.rigid(); ++rotor) {
    if (!space.base[rotor].is_rotor || !torque.fit.free[rotor] || out.parameters[rotor]) continue;
    const Joint joint = space.base[rotor].joint;
    const int offset = space.offset(joint.index());
    if (torque.wanted[offset] || robot.known.count(fmt::format("fo{}", joint)) > 0) continue;
    std::vector<bool> wanted = torque.fit.free;
    wanted[offset] = true;
    const ColumnSelection with = select_columns(a, wanted, space.rigid());
    if (!with.confounded[offset]) continue;
    out.leaning.push_back(joint);
    for (int p = 0; p < space.rigid(); ++p)
      if (torque.fit.free[p] && with.confounded[p]) out.parameters[p] = true;
  }
  return out;
}

}  // namespace

std::vector<Joint> undriven_joints(const TorqueFit& torque) {
  const ParameterSpace& space = torque.space;
  const int n = space.joints();
  const Eigen::VectorXd friction = friction_share(space, torque);
  Eigen::VectorXd square = Eigen::VectorXd::Zero(n), rows = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 0; k < torque.system.y.size(); ++k)
    if (torque.system.use[k] > 0.0) {
      square[torque.system.joint[k]] += torque.system.y[k] * torque.system.y[k];
      rows[torque.system.joint[k]] += 1.0;
    }
  const Eigen::VectorXd rms = square.cwiseQuotient(rows.cwiseMax(1.0)).cwiseSqrt();
  std::vector<Joint> undriven;
  for (int j = 0; j < n; ++j)
    for (int other = 0; other < n; ++other)
      if (space.chain.geometry[other].kind == space.chain.geometry[j].kind && rows[j] > 0.0 &&
          (rms[j] < kUndrivenShare * rms[other] || (rms[j] < rms[other] && friction[j] > kFrictionAlone))) {
        undriven.push_back(Joint::at(j));
        break;
      }
  return undriven;
}

Confounded confounded_parameters(const Robot& robot, const std::vector<Joint>& still,
                                 const std::vector<Joint>& undriven, const TorqueFit& torque) {
  const ParameterSpace& space = torque.space;
  const std::vector<bool> otherwise = undriven_parameters(space, undriven, torque);
  std::vector<bool> confounded = torque.fit.confounded;
  for (int p = 0; p < space.rigid(); ++p)
    confounded[p] = confounded[p] || otherwise[p] || is_shown_at_rest(torque.system, p, still);
  return with_offsets(space, robot, torque, std::move(confounded));
}

}  // namespace faultline
