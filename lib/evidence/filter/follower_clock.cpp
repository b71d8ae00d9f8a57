// SPDX-License-Identifier: MIT
// When the rows were taken, where their stamps wobble.
#include <algorithm>
#include <cmath>

#include "lib/evidence/filter/follower.hpp"

namespace faultline {
namespace {

constexpr double kLostStep = 0.75;   // of a period: a stamp farther off is believed
constexpr double kLeastStep = 0.1;   // of a period
constexpr double kClockGain = 0.01;  // of what a stamp is off: drift of a clock is slow
constexpr double kClearStamp = 0.3;  // of a period off whole ones: a stamp farther off leaves two readings

}  // namespace

/// So many periods, of which the stamps only keep the clock from drifting.
double Follower::step_in_periods(double since, double periods) const {
  const double period = model_.steady_period_s, late = since - periods * period;
  const bool lost = std::abs(late) > kLostStep * period;
  return lost ? std::max(since, kLeastStep * period) : periods * period + kClockGain * late;
}

/// Of the row, if it came so long after the one before.
double Follower::log_likelihood_after(const FollowedSample& out, double dt) const {
  FollowedSample at = out;
  GaussianState state = state_;
  const int n = model_.joints();
  at.dt = dt;
  for (int j = 0; j < n; ++j) at.pressed[j] = faults_.held[j] || is_pressed(at, j);
  const JointArray speed_before = motion_of(state.mean, n).dq;
  predict(state, model_, dynamics_, step_to(at, last_torque_, last_torque_missing_), nullptr, 0.0);
  set_measurement_noise(state, speed_before, at);
  double sum = 0.0;
  for (int j = 0; j < n; ++j) sum += observe_joint(state, n, at, j).log_likelihood;
  return sum;
}

/// Seconds since the row before. Where the model knows that rows are taken in step and only their stamps
/// wobble, the steps are whole periods; where a stamp does not say how many, the motion does.
double Follower::step_to_stamp(const FollowedSample& out) {
  const double period = model_.steady_period_s, since = out.time - clock_;
  double step = out.time - last_time_;
  if (period > 0.0) {
    const double periods = std::max(std::round(since / period), 1.0), off = since / period - periods;
    step = step_in_periods(since, periods);
    const double other_periods = periods + (off > 0.0 ? 1.0 : -1.0);
    if (std::abs(off) > kClearStamp && other_periods >= 1.0) {
      const double other = step_in_periods(since, other_periods);
      if (log_likelihood_after(out, other) > log_likelihood_after(out, step)) step = other;
    }
  }
  clock_ += step;
  return step;
}

}  // namespace faultline
