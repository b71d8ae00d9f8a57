// SPDX-License-Identifier: MIT
#include "lib/identify/motion/velocity_agreement.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

constexpr double kAlike = 0.9;        // correlation above which both are one quantity
constexpr double kFactorApart = 1.2;  // factor between them that no noise makes
constexpr double kNear = 0.05;        // of a known factor, in its logarithm
constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

bool is_near(double factor, double known) {
  return std::abs(elementary::log(std::abs(factor) / known)) < kNear;
}

}  // namespace

bool DerivativeAgreement::disagrees() const {
  return std::abs(correlation) > kAlike &&
         (factor < 0.0 || std::abs(elementary::log(factor)) > elementary::log(kFactorApart));
}

DerivativeAgreement velocity_agreement(const JointMotion& motion) {
  JointMotion alone = motion;
  alone.dq.resize(0);
  const Eigen::VectorXd derived = smooth_motion(alone, fit_motion_noise(alone)).dq;
  double dd = 0.0, dm = 0.0, mm = 0.0;
  for (int k = 0; k < motion.rows(); ++k) {
    if (motion.dq_off[k]) continue;
    dd += derived[k] * derived[k];
    dm += derived[k] * motion.dq[k];
    mm += motion.dq[k] * motion.dq[k];
  }
  if (dd <= 0.0 || mm <= 0.0) return {};
  return {dm / dd, dm / std::sqrt(dd * mm)};
}

std::string words(const DerivativeAgreement& agreement, int joint) {
  const double factor = agreement.factor;
  std::string guess = "one of them is in another unit";
  if (is_near(factor, kDegreesPerRadian) || is_near(factor, 1.0 / kDegreesPerRadian))
    guess = "one of them is in degrees";
  if (is_near(factor, 1e3) || is_near(factor, 1e-3))
    guess = "one of them is in mm, or the time in milliseconds";
  if (factor < 0.0)
    guess = is_near(factor, 1.0) ? "one of them has the other sign" : guess + " and the other sign";
  return fmt::format("dq{0} is {1:.4g} times the derivative of q{0}: {2}; dq{0} was left out", joint, factor,
                     guess);
}

}  // namespace faultline
