// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/follower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

constexpr double kFreshCodes = 8.0;       // rows: a joint that moves slowly shows one code for as long
constexpr double kMostSameCodes = 256.0;  // rows
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLogTwoPi = 1.8378770664093453;  // log(2 pi)
constexpr double kRangeMargin = 0.03;             // of the range: stops stand outside what healthy logs visit
constexpr double kStandstill = 0.1;               // of the usual velocity: slower is not moving outward
constexpr double kGapPeriods = 5.5;               // a gap of more than five periods starts the filter anew
constexpr int kMostHeldRows = 4;       // likewise of rows without torque: it is held over them, and no longer
constexpr double kLeastGap_s = 1e-9;   // of logs whose time stands still
constexpr double kSurelyBraked = 5.0;  // standard deviations of dq
constexpr double kSurelyFaster = 2.0;  // times the usual velocity: what a joint seldom reaches
constexpr double kFarBeyond = 20.0;    // times the usual speed or the largest torque: a filter gone astray
constexpr double kDriveLevel_s = 0.02;      // slower than feedback of noise, faster than motions
constexpr double kPeriodForgetting = 0.02;  // share of a new sample in the usual period: some 50 samples

double velocity_read(const Log& segment, int row, int joint) {
  return segment.dq.empty() ? kNaN : segment.dq[joint][row];
}

double root_of_squares(double a, double b) { return std::sqrt(a * a + b * b); }

}  // namespace

JointObservation observe_joint(GaussianState& state, int n, const FollowedSample& sample, int j,
                               const SensorError& error) {
  JointObservation out;
  double variances = 1.0;
  int measured = 0;
  auto take = [&](int index, double factor, double z, double std, double tail, double& whitened) {
    if (!std::isfinite(z)) return;
    const ScalarUpdate update =
        observe(state, index, factor != 0.0 ? error.size_index : -1, factor, z, std * std, tail);
    whitened = update.innovation / std::sqrt(update.variance);
    out.chi_square += std::min(update.chi_square(), kChiSquareCap);
    variances *= update.variance;
    ++measured;
  };
  take(j, error.on_q, sample.q[j], sample.q_std[j], sample.q_tail[j], out.whitened_q);
  take(n + j, error.on_dq, sample.dq[j], sample.dq_std[j], sample.dq_tail[j], out.whitened_dq);
  out.log_likelihood = -0.5 * (out.chi_square + elementary::log(variances) + measured * kLogTwoPi);
  return out;
}

void RepeatedCodes::take(int j, double reading) {
  if (!std::isfinite(reading)) return;
  const bool is_same = reading == last_[j] || reading == other_[j];
  rows_[j] = is_same ? std::min(rows_[j] + 1.0, kMostSameCodes) : 0.0;
  if (reading != last_[j]) other_[j] = last_[j];
  last_[j] = reading;
}

double RepeatedCodes::noise_factor(int j) const {
  return std::sqrt(1.0 + std::max(rows_[j] - kFreshCodes, 0.0));
}

Step step_to(const FollowedSample& at, const JointArray& torque_before, const JointFlags& missing_before) {
  return {at.dt, torque_before, at.torque, at.drive_level, at.pressed, missing_before, at.torque_missing};
}

/// Noise of the sensors, and what an error of the time stamp makes of speed and acceleration.
void Follower::set_measurement_noise(const GaussianState& state, const JointArray& speed_before,
                                     FollowedSample& out) const {
  const int n = model_.joints();
  for (int j = 0; j < n; ++j) {
    out.q_tail[j] = model_.q_tail.empty() ? kNoTail : model_.q_tail[j];
    out.dq_tail[j] = model_.dq_tail.empty() ? kNoTail : model_.dq_tail[j];
    const double fastest = kFarBeyond * model_.velocity_scale[j];
    const double steepest = kFarBeyond * model_.torque_scale[j] / model_.inertia_scale[j];
    const double speed = std::clamp(state.mean[n + j], -fastest, fastest);
    const double acceleration =
        std::clamp((state.mean[n + j] - speed_before[j]) / out.dt, -steepest, steepest);
    out.q_std[j] = root_of_squares(q_codes_.noise_factor(j) * noise_.q_scale[j] * model_.q_std[j],
                                   model_.clock_std * speed);
    out.dq_std[j] = root_of_squares(noise_.dq_scale[j] * model_.dq_std[j], model_.clock_std * acceleration);
  }
}

Follower::Follower(const MotionModel& model, const LogNoise& noise)
    : model_(model), noise_(noise), dynamics_(model) {
  for (int j = 0; j < model.joints(); ++j) {
    const double margin = kRangeMargin * (model.q_high[j] - model.q_low[j]);
    low_[j] = model.q_low[j] - margin;
    high_[j] = model.q_high[j] + margin;
    if (!model.dq_is_difference.empty() && model.dq_is_difference[j]) noise_.dq_is_difference[j] = true;
  }
}

bool Follower::is_pressed(const FollowedSample& sample, int j) const {
  const double q = sample.q[j];
  if (!std::isfinite(q) || (q >= low_[j] && q <= high_[j])) return false;
  const double side = q > high_[j] ? 1.0 : -1.0;
  const double braked = side * (last_dq_[j] - sample.dq[j]);  // NaN where nothing was measured
  const double by_drive = model_.torque_scale[j] / model_.inertia_scale[j] * sample.dt;
  if (braked > by_drive + kSurelyBraked * model_.dq_std[j]) return true;
  const double moved = std::isfinite(sample.dq[j]) ? sample.dq[j] * sample.dt : q - last_q_[j];
  const double still = kStandstill * model_.velocity_scale[j] * sample.dt;
  return q > high_[j] ? moved < still : moved > -still;
}

void Follower::read_row(const Log& segment, int row, FollowedSample& out) const {
  out.row = segment.first_row + row;
  out.drive_level = drive_level_;
  out.time = segment.time[row];
  for (int j = 0; j < model_.joints(); ++j) {
    const double q = segment.q[j][row], dq = velocity_read(segment, row, j);
    const double torque = segment.tau.empty() ? kNaN : segment.tau[j][row];
    out.torque_missing[j] = !std::isfinite(torque);
    out.torque[j] = out.torque_missing[j] ? last_torque_[j] : torque;
    out.repeats[j] =
        started_ && !noise_.repeats_say_nothing && q == last_q_[j] && (std::isnan(dq) || dq == last_dq_[j]);
    out.q[j] = q;
    out.dq[j] = noise_.dq_is_difference[j] ? kNaN : dq;
  }
}

/// Days differ; after a gap (s) the day is still the same.
void Follower::restart_slow_states(double gap_s) {
  const int n = model_.joints(), size = model_.healthy_states();
  const GaussianState before = state_;
  state_.size = size;
  std::fill_n(state_.mean.begin(), size, 0.0);
  std::fill_n(state_.covariance.begin(), size * size, 0.0);
  for (int s = 2 * n; s < size; ++s) {
    const SlowState& slow = model_.slow[s - 2 * n];
    const bool forgotten = !started_ || slow.memory_s > 0.0;
    state_.p(s, s) = slow.day_std * slow.day_std;
    if (forgotten) continue;
    state_.mean[s] = before.mean[s];
    for (int other = 2 * n; other < size; ++other)
      if (model_.slow[other - 2 * n].memory_s <= 0.0) state_.p(s, other) = before.p(s, other);
    state_.p(s, s) += slow.walk * slow.walk * gap_s;
  }
}

void Follower::start(FollowedSample& out) {
  const int n = model_.joints();
  restart_slow_states(out.time - last_time_);
  for (int j = 0; j < n; ++j) {
    const bool has_q = std::isfinite(out.q[j]), has_dq = std::isfinite(out.dq[j]);
    const double range = model_.q_high[j] - model_.q_low[j];
    state_.mean[j] = has_q ? out.q[j] : 0.5 * (model_.q_low[j] + model_.q_high[j]);
    state_.mean[n + j] = has_dq ? out.dq[j] : 0.0;
    const double q_std = has_q ? noise_.q_scale[j] * model_.q_std[j] : range;
    const double dq_std =
        has_dq ? noise_.dq_scale[j] * model_.dq_std[j] : kSurelyFaster * model_.velocity_scale[j];
    state_.p(j, j) = q_std * q_std;
    state_.p(n + j, n + j) = dq_std * dq_std;
    out.log_likelihood[j] = out.chi_square[j] = out.whitened[j] = out.whitened[n + j] = 0.0;
    out.repeats[j] = out.pressed[j] = false;
    speed_unknown_[j] = !has_dq;
    out.in_range = true;
  }
  out.dt = 0.0;
  out.total_log_likelihood = 0.0;
  started_ = true;
}

/// A filter that has lost its robot may take the tip for lighter than nothing, which no step survives.
void Follower::keep_some_mass() {
  for (std::size_t s = 0; s < model_.slow.size(); ++s)
    if (model_.slow[s].kind == SlowKind::tip_mass) {
      double& mass = state_.mean[2 * model_.joints() + static_cast<int>(s)];
      mass = std::max(mass, dynamics_.least_payload());
    }
}

/// A log may begin in the middle of a move. Friction bends most at rest, so the step must be linearised where
/// the joint is; the doubt of the speed stays what it was.
void Follower::guess_unknown_speed(const FollowedSample& out) {
  const int n = model_.joints();
  for (int j = 0; j < n; ++j) {
    if (!speed_unknown_[j] || !std::isfinite(out.q[j]) || !std::isfinite(last_q_[j]) || !(out.dt > 0.0))
      continue;
    const double fastest = kFarBeyond * model_.velocity_scale[j];
    state_.mean[n + j] = std::clamp((out.q[j] - state_.mean[j]) / out.dt, -fastest, fastest);
    speed_unknown_[j] = false;
  }
}

void Follower::follow(const Log& segment, int row, FollowedSample& out) {
  const int n = model_.joints();
  read_row(segment, row, out);
  const double dt = started_ ? step_to_stamp(out) : 0.0;
  const bool gap = started_ && usual_dt_ > 0.0 && dt > std::max(kGapPeriods * usual_dt_, kLeastGap_s);
  const bool no_torque =
      rows_without_torque_ > kMostHeldRows;  // before this row: nothing is judged without it
  rows_without_torque_ = out.lacks_torque(n) ? rows_without_torque_ + 1 : 0;
  if (!started_ || gap || no_torque) {
    start(out);
    clock_ = out.time;
    clock_rows_ = 1.0;
  } else {
    usual_dt_ = usual_dt_ > 0.0 ? usual_dt_ + kPeriodForgetting * (dt - usual_dt_) : dt;
    out.dt = dt;
    out.in_range = true;
    for (int j = 0; j < n; ++j) {
      out.pressed[j] = is_pressed(out, j);
      out.in_range = out.in_range && !(out.q[j] < low_[j]) && !(out.q[j] > high_[j]);
    }
    for (int j = 0; j < n; ++j) q_codes_.take(j, segment.q[j][row]);
    guess_unknown_speed(out);
    const JointArray speed_before = motion_of(state_.mean, n).dq;
    predict(state_, model_, dynamics_, step_to(out, last_torque_, last_torque_missing_), nullptr, 0.0);
    set_measurement_noise(state_, speed_before, out);
    out.total_log_likelihood = 0.0;
    for (int j = 0; j < n; ++j) {
      const JointObservation seen = observe_joint(state_, n, out, j);
      out.log_likelihood[j] = seen.log_likelihood;
      out.chi_square[j] = seen.chi_square;
      out.whitened[j] = seen.whitened_q;
      out.whitened[n + j] = seen.whitened_dq;
      out.total_log_likelihood += seen.log_likelihood;
    }
  }
  keep_some_mass();
  out.posterior = state_;
  last_time_ = out.time;
  for (int j = 0; j < n; ++j) {
    last_q_[j] = segment.q[j][row];
    last_dq_[j] = velocity_read(segment, row, j);
  }
  const double passes = out.dt > 0.0 ? elementary::exp(-out.dt / kDriveLevel_s) : 0.0;
  for (int j = 0; j < n; ++j) drive_level_[j] = out.torque[j] + passes * (drive_level_[j] - out.torque[j]);
  last_torque_ = out.torque;
  last_torque_missing_ = out.torque_missing;
}

}  // namespace faultline
