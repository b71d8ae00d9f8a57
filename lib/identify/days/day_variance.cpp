// SPDX-License-Identifier: MIT
#include "lib/identify/days/day_variance.hpp"

namespace faultline {
namespace {

constexpr double kUnseenDays = 2.0;  // times the variance between the days that were seen

/// Standard deviations of the effects, relative but for the offset, which is a share of the joint's torque
/// rms, and the delay, which is in samples.
struct EffectStd {
  double inertia, friction, slope, gain, offset, width, delay;
};

// First: what robots differ by from day to day. Least: what makes no difference to any judgement. Unseen:
// what a few days cannot show (friction by the warmth of the gear, inertia and torque constants as drives are
// made, friction near rest, where healthy logs have few rows).
constexpr EffectStd kFirst{1.7e-3, 0.1, 0.03, 1.7e-3, 2e-3, 0.1, 0.1};
constexpr EffectStd kLeast{3e-4, 0.01, 3e-3, 3e-4, 2e-4, 0.02, 0.01};
constexpr EffectStd kUnseen{1e-2, 0.05, 0.03, 1e-2, 1e-3, 0.1, 0.3};

Eigen::VectorXd variance_of(const BalanceModel& model, const EffectStd& std) {
  const DayLayout day = day_layout(model.rigid);
  Eigen::VectorXd out = Eigen::VectorXd::Constant(day.count(), std.inertia * std.inertia);
  out[day.delay()] = std.delay * std.delay;
  for (int j = 0; j < model.joints(); ++j) {
    const double offset = std.offset * model.torque_rms[j];
    out[day.friction(j)] = std.friction * std.friction;
    out[day.friction_slope(j)] = std.slope * std.slope;
    out[day.gain(j)] = std.gain * std.gain;
    out[day.offset(j)] = offset * offset;
    out[day.friction_width(j)] = std.width * std.width;
  }
  return out;
}

/// Gain and offset of a slide that gravity pulls along look like a mass: they are no effects of their own.
Eigen::VectorXd without_doubles(const BalanceModel& model, Eigen::VectorXd variance) {
  const DayLayout day = day_layout(model.rigid);
  for (int j = 0; j < model.joints(); ++j)
    if (carries_weight(model.rigid, j)) variance[day.gain(j)] = variance[day.offset(j)] = kNoEffect;
  return variance;
}

}  // namespace

Eigen::VectorXd first_day_variance(const BalanceModel& model) {
  return without_doubles(model, variance_of(model, kFirst));
}

Eigen::VectorXd variance_between_days(const BalanceModel& model, const Eigen::VectorXd& moments) {
  return without_doubles(model, moments.cwiseMax(variance_of(model, kLeast)));
}

Eigen::VectorXd prior_of_a_day(const BalanceModel& model, const Eigen::VectorXd& between) {
  return without_doubles(model, kUnseenDays * between + variance_of(model, kUnseen));
}

}  // namespace faultline
