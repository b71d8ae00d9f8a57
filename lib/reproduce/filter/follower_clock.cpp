// SPDX-License-Identifier: MIT
// When the rows were taken, where their stamps wobble.
#include <algorithm>
#include <cmath>

#include "lib/reproduce/filter/follower.hpp"

namespace faultline {
namespace {

constexpr double kLostClock = 3.0;     // periods: stamps that lie this far before the clock are believed
constexpr double kLeastStep = 0.1;     // of a period
constexpr double kClockGain = 0.01;    // of what a stamp is off: drift of a clock is slow
constexpr double kLeastWobble = 0.05;  // of a period, as a standard deviation
constexpr double kRowLost = 5.0;       // nats against each row that was not logged
// What two numbers of periods may differ by in nats, and still the motion is asked. Less is told by no stamp.
constexpr double kUnclear = 10.0;
constexpr double kFits = 16.0;  // chi-square of a joint: a motion that fits worse says nothing of the clock
constexpr double kElsewhere = 0.4;    // of the way of a period,
constexpr double kFarthestOff = 1.0;  // periods by which what the stamp says is tried to be off
constexpr double kSurely = 4.0;       // and so many standard deviations of a position beyond

}  // namespace

/// So many periods, of which the stamps only keep the clock from drifting.
double Follower::step_in_periods(double since, double periods) const {
  const double period = model_.steady_period_s, late = since - periods * period;
  const bool lost = late < -kLostClock * period;
  return lost ? std::max(since, kLeastStep * period) : periods * period + kClockGain * late;
}

/// What the stamp alone says for so many periods, nats.
double Follower::log_likelihood_of_stamp(double since, double periods) const {
  const double late = since / model_.steady_period_s - periods;
  return -0.5 * late * late / wobble_ - kRowLost * (periods - 1.0);
}

/// After a step of `step`. What the first stamps are off says where the clock stands: their mean is believed.
void Follower::set_clock(double since, double step) {
  const double gain = std::max(1.0 / ++clock_rows_, kClockGain);
  const double late = since - step, off = late / model_.steady_period_s;
  clock_ += step + (gain - kClockGain) * late;
  wobble_ += kClockGain * (std::clamp(off * off, kLeastWobble * kLeastWobble, 1.0) - wobble_);
}

/// How the row fits, if it came so long after the one before.
Follower::RowFit Follower::fit_after(const FollowedSample& out, double dt) const {
  FollowedSample at = out;
  GaussianState state = state_;
  const int n = model_.joints();
  at.dt = dt;
  for (int j = 0; j < n; ++j) at.pressed[j] = is_pressed(at, j);
  const JointArray speed_before = motion_of(state.mean, n).dq;
  predict(state, model_, dynamics_, step_to(at, last_torque_, last_torque_missing_), nullptr, 0.0);
  set_measurement_noise(state, speed_before, at);
  RowFit fit;
  for (int j = 0; j < n; ++j) {
    at.q_tail[j] = at.dq_tail[j] = kNoTail;
    const JointObservation seen = observe_joint(state, n, at, j);
    fit.log_likelihood += seen.log_likelihood;
    fit.chi_square[j] = seen.chi_square;
  }
  return fit;
}

/// Whether there is a joint that moves as expected after one step and not after the other, and none that says
/// the contrary: after a fault began, the others still tell the time.
bool Follower::tells(const RowFit& likelier, const RowFit& other) const {
  bool any = false;
  for (int j = 0; j < model_.joints(); ++j) {
    const double fits = likelier.chi_square[j], misfits = other.chi_square[j];
    if (misfits < kFits && fits > misfits + kFits) return false;
    any = any || (fits < kFits && misfits > fits + kFits);
  }
  return any;
}

/// Whether the readings lie off where the speeds lead in `dt`, by a good part of what they lead in a period.
bool Follower::is_elsewhere(const FollowedSample& out, double dt) const {
  const int n = model_.joints();
  const MotionState motion = motion_of(state_.mean, n);
  for (int j = 0; j < n; ++j) {
    const double off = std::abs(out.q[j] - motion.q[j] - motion.dq[j] * dt);
    const double way = std::abs(motion.dq[j]) * model_.steady_period_s;
    if (off > kElsewhere * way + kSurely * model_.q_std[j]) return true;
  }
  return false;
}

/// The likeliest number of periods by stamp and motion, where the motion tells it from `by_stamp`: a stamp
/// may be off by more than a period, as late as it seldom is.
double Follower::periods_by_motion(const FollowedSample& out, double since, double by_stamp) const {
  const double first = std::max(by_stamp - kFarthestOff, 1.0);
  const RowFit as_stamped = fit_after(out, step_in_periods(since, by_stamp));
  const auto likelihood = [&](const RowFit& fit, double periods) {
    return fit.log_likelihood + log_likelihood_of_stamp(since, periods);
  };
  double best = by_stamp, most = likelihood(as_stamped, by_stamp);
  for (double periods = first; periods <= by_stamp + kFarthestOff; ++periods) {
    if (periods == by_stamp) continue;
    const RowFit fit = fit_after(out, step_in_periods(since, periods));
    if (likelihood(fit, periods) <= most || !tells(fit, as_stamped)) continue;
    most = likelihood(fit, periods);
    best = periods;
  }
  return best;
}

/// Seconds since the row before. Where the model knows that rows are taken in step and only their stamps
/// wobble, the steps are whole periods; where a stamp does not say how many, the motion does.
double Follower::step_to_stamp(const FollowedSample& out) {
  const double period = model_.steady_period_s, since = out.time - clock_;
  if (period <= 0.0) {
    clock_ = out.time;
    return out.time - last_time_;
  }
  const double fewer = std::max(std::floor(since / period), 1.0), more = fewer + 1.0;
  const double clear = log_likelihood_of_stamp(since, fewer) - log_likelihood_of_stamp(since, more);
  double periods = clear >= 0.0 ? fewer : more;
  if (std::abs(clear) < kUnclear || is_elsewhere(out, step_in_periods(since, periods)))
    periods = periods_by_motion(out, since, periods);
  const double step = step_in_periods(since, periods);
  set_clock(since, step);
  return step;
}

}  // namespace faultline
