// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "lib/core/matrix/decompositions.hpp"
#include "lib/identify/excitation/excitation.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/identify/torque_fit.hpp"
#include "lib/identify/verdict/residual_pattern.hpp"

namespace faultline {
namespace {

constexpr double kOneWay = 0.98;   // of the moving windows in one direction: beyond, the motion is one-way
constexpr double kOneSpeed = 0.1;  // standard deviation over mean of the speed: below, the speed is constant
constexpr double kLeastScale = 0.03;  // of the largest torque scale of the same kind of joint
constexpr double kNotShown = 1e-9;    // of the torque scale: smaller columns are zero
constexpr double kWorthNaming = 0.1;  // of the largest weight: least weight listed in the weakest mixture
constexpr double kLeastEigenvalue = 1e-14;  // of the scaled moments: rounding; the inverse stays finite

std::string what_lacks(const JointFit& fit, double forward, bool still) {
  if (still) return "it never moves";
  if (forward > kOneWay)
    return "it moves forward only: its friction cannot be separated from an offset of its torque";
  if (forward < 1.0 - kOneWay)
    return "it moves backward only: its friction cannot be separated from an offset of its torque";
  double count = 0.0, sum = 0.0, square = 0.0;
  for (std::size_t k = 0; k < fit.size(); ++k) {
    if (!fit.moving[k]) continue;
    count += 1.0;
    sum += std::abs(fit.dq[k]);
    square += fit.dq[k] * fit.dq[k];
  }
  const double mean = sum / std::max(count, 1.0);
  if (square / std::max(count, 1.0) - mean * mean < kOneSpeed * kOneSpeed * mean * mean)
    return "it moves at one speed: its viscous friction cannot be separated from its Coulomb friction";
  return "";
}

JointExcitation of_joint(const JointFit& fit, bool still) {
  JointExcitation out;
  double forward = 0.0, moving = 0.0;
  for (std::size_t k = 0; k < fit.size(); ++k) {
    out.q_low = k ? std::min(out.q_low, fit.q[k]) : fit.q[k];
    out.q_high = k ? std::max(out.q_high, fit.q[k]) : fit.q[k];
    out.fastest_forward = std::max(out.fastest_forward, fit.dq[k]);
    out.fastest_back = std::max(out.fastest_back, -fit.dq[k]);
    if (!fit.moving[k]) continue;
    moving += 1.0;
    forward += fit.dq[k] > 0.0;
  }
  out.forward = moving > 0.0 && !still ? forward / moving : std::numeric_limits<double>::quiet_NaN();
  out.lacks = what_lacks(fit, out.forward, still);
  return out;
}

/// Returns the base parameters, with the fitted rotors only, and the friction of every joint.
std::vector<int> judged_columns(const TorqueFit& torque, const ParameterSpace& space) {
  std::vector<int> columns;
  for (int p = 0; p < space.offset(0); ++p)
    if (p >= space.rigid() || !space.base[p].is_rotor || torque.wanted[p]) columns.push_back(p);
  return columns;
}

/// Returns the torque residual of each joint, none far smaller than the largest of the same kind of joint.
Eigen::VectorXd joint_scales(const ParameterSpace& space, const std::vector<double>& residual_rms) {
  const Eigen::Map<const Eigen::VectorXd> rms(residual_rms.data(), space.joints());
  Eigen::VectorXd scale(space.joints());
  for (int j = 0; j < space.joints(); ++j)
    scale[j] = std::max({rms[j], kLeastScale * largest_alike(space, rms, j), 1e-9});
  return scale;
}

Eigen::MatrixXd moments_of(const WeakSystem& s, const std::vector<int>& columns,
                           const Eigen::VectorXd& scale) {
  Eigen::MatrixXd a = s.a(Eigen::all, columns);
  for (Eigen::Index k = 0; k < a.rows(); ++k) a.row(k) /= scale[s.joint[k]];
  return a.transpose() * a / static_cast<double>(std::max<Eigen::Index>(a.rows() / s.joints, 1));
}

/// Inverse of the moments of the excited columns, each scaled to one.
struct Inverse {
  std::vector<int> shown;
  Eigen::MatrixXd inverse;
  Eigen::VectorXd weakest;
};

Inverse invert(const Eigen::MatrixXd& moments, const std::vector<bool>& at_rest) {
  Inverse out;
  for (int i = 0; i < moments.rows(); ++i)
    if (!at_rest[i] && moments(i, i) > kNotShown * kNotShown) out.shown.push_back(i);
  if (out.shown.empty()) return out;
  const Eigen::MatrixXd part = moments(out.shown, out.shown);
  const Eigen::VectorXd root = part.diagonal().cwiseSqrt().cwiseInverse();
  const SymmetricEigen eigen = symmetric_eigen(root.asDiagonal() * part * root.asDiagonal());
  const Eigen::VectorXd values = eigen.values.cwiseMax(kLeastEigenvalue);
  out.inverse = eigen.vectors * values.cwiseInverse().asDiagonal() * eigen.vectors.transpose();
  out.weakest = eigen.vectors.col(0);
  return out;
}

/// Returns the excitation with its parameters and the least determined combination, from its moments.
Excitation with_parameters(const ParameterSpace& space, const std::vector<bool>& at_rest, Excitation out) {
  const Inverse inverse = invert(out.moments, at_rest);
  for (const int column : out.columns)
    out.parameters.push_back({space.name(column), std::numeric_limits<double>::quiet_NaN(), ""});
  const auto count = static_cast<Eigen::Index>(inverse.shown.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    ParameterExcitation& p = out.parameters[inverse.shown[i]];
    p.own = std::sqrt(1.0 / inverse.inverse(i, i));
    Eigen::Index hardest = i == 0 ? 1 : 0;
    for (Eigen::Index k = 0; k < count; ++k)
      if (k != i && std::abs(inverse.inverse(i, k)) / std::sqrt(inverse.inverse(k, k)) >
                        std::abs(inverse.inverse(i, hardest)) / std::sqrt(inverse.inverse(hardest, hardest)))
        hardest = k;
    if (count > 1) p.mixed_with = out.parameters[inverse.shown[hardest]].name;
  }
  if (count == 0) return out;
  Eigen::Index largest = 0;
  inverse.weakest.cwiseAbs().maxCoeff(&largest);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double weight = inverse.weakest[i] / inverse.weakest[largest];
    if (std::abs(weight) >= kWorthNaming)
      out.weakest.emplace_back(out.parameters[inverse.shown[i]].name, weight);
  }
  return out;
}

}  // namespace

Excitation motion_excitation(const TorqueFit& torque, const std::vector<JointFit>& fits,
                             const std::vector<double>& residual_rms, const std::vector<Joint>& still) {
  const ParameterSpace& space = torque.space;
  Excitation out;
  for (int j = 0; j < space.joints(); ++j)
    out.joints.push_back(of_joint(fits[j], has_joint(still, Joint::at(j))));
  out.columns = judged_columns(torque, space);
  out.joint_scale = joint_scales(space, residual_rms);
  out.moments = moments_of(torque.system, out.columns, out.joint_scale);
  std::vector<bool> at_rest;
  for (const int p : out.columns) at_rest.push_back(is_shown_at_rest(torque.system, p, still));
  return with_parameters(space, at_rest, std::move(out));
}

}  // namespace faultline
