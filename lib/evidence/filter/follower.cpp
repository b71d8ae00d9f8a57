// SPDX-License-Identifier: MIT
#include "lib/evidence/filter/follower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faultline {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLogTwoPi = 1.8378770664093453;  // log(2 pi)
constexpr double kRangeMargin = 0.03;             // of the range: stops stand outside what healthy logs visit
constexpr double kStandstill = 0.1;               // of the usual velocity: slower is not moving outward
constexpr double kGapPeriods = 5.5;               // a gap of more than five periods starts the filter anew
constexpr double kLeastGap_s = 1e-9;              // of logs whose time stands still
constexpr double kPeriodForgetting = 0.02;  // share of a new sample in the usual period: some 50 samples

}  // namespace

JointObservation observe_joint(GaussianState& state, const MotionModel& model, const FollowedSample& sample,
                               int j, const SensorError& error) {
  const int n = model.joints();
  JointObservation out;
  double variances = 1.0;
  int measured = 0;
  auto take = [&](int index, double factor, double z, double std, double& whitened) {
    if (!std::isfinite(z)) return;
    const ScalarUpdate update =
        observe(state, index, factor != 0.0 ? error.size_index : -1, factor, z, std * std);
    whitened = update.innovation / std::sqrt(update.variance);
    out.chi_square += std::min(update.chi_square(), kChiSquareCap);
    variances *= update.variance;
    ++measured;
  };
  take(j, error.on_q, sample.q[j], model.q_std[j], out.whitened_q);
  take(n + j, error.on_dq, sample.dq[j], model.dq_std[j], out.whitened_dq);
  out.log_likelihood = -0.5 * (out.chi_square + std::log(variances) + measured * kLogTwoPi);
  return out;
}

Step step_to(const FollowedSample& at, const JointArray& torque_before, const JointFlags& missing_before) {
  return {at.dt, torque_before, at.torque, at.pressed, missing_before, at.torque_missing};
}

Follower::Follower(const MotionModel& model) : model_(model), dynamics_(model) {
  for (int j = 0; j < model.joints(); ++j) {
    const double margin = kRangeMargin * (model.q_high[j] - model.q_low[j]);
    low_[j] = model.q_low[j] - margin;
    high_[j] = model.q_high[j] + margin;
  }
}

void Follower::learn_range(const FollowedSample& sample) {
  for (int j = 0; j < model_.joints(); ++j) {
    const double margin = kRangeMargin * (model_.q_high[j] - model_.q_low[j]);
    low_[j] = std::min(low_[j], sample.posterior.mean[j] - margin);
    high_[j] = std::max(high_[j], sample.posterior.mean[j] + margin);
  }
}

bool Follower::is_pressed(const FollowedSample& sample, int j) const {
  const double q = sample.q[j];
  if (!std::isfinite(q) || (q >= low_[j] && q <= high_[j])) return false;
  const double moved = std::isfinite(sample.dq[j]) ? sample.dq[j] * sample.dt : q - last_q_[j];
  const double still = kStandstill * model_.velocity_scale[j] * sample.dt;
  return q > high_[j] ? moved < still : moved > -still;
}

void Follower::read_row(const Log& segment, int row, FollowedSample& out) const {
  out.row = segment.first_row + row;
  out.time = segment.time[row];
  for (int j = 0; j < model_.joints(); ++j) {
    out.q[j] = segment.q[j][row];
    out.dq[j] = segment.dq.empty() ? kNaN : segment.dq[j][row];
    const double torque = segment.tau.empty() ? kNaN : segment.tau[j][row];
    out.torque_missing[j] = !std::isfinite(torque);
    out.torque[j] = out.torque_missing[j] ? last_torque_[j] : torque;
    out.repeats[j] = started_ && out.q[j] == last_q_[j] && (segment.dq.empty() || out.dq[j] == last_dq_[j]);
  }
}

void Follower::start(FollowedSample& out) {
  const int n = model_.joints();
  state_.size = 2 * n;
  std::fill_n(state_.covariance.begin(), 4 * n * n, 0.0);
  for (int j = 0; j < n; ++j) {
    const bool has_q = std::isfinite(out.q[j]), has_dq = std::isfinite(out.dq[j]);
    const double range = model_.q_high[j] - model_.q_low[j];
    state_.mean[j] = has_q ? out.q[j] : 0.5 * (model_.q_low[j] + model_.q_high[j]);
    state_.mean[n + j] = has_dq ? out.dq[j] : 0.0;
    const double q_std = has_q ? model_.q_std[j] : range;
    const double dq_std = has_dq ? model_.dq_std[j] : 2.0 * model_.velocity_scale[j];
    state_.p(j, j) = q_std * q_std;
    state_.p(n + j, n + j) = dq_std * dq_std;
    out.log_likelihood[j] = out.chi_square[j] = out.whitened[j] = out.whitened[n + j] = 0.0;
    out.repeats[j] = out.pressed[j] = false;
  }
  out.dt = 0.0;
  out.total_log_likelihood = 0.0;
  started_ = true;
}

void Follower::follow(const Log& segment, int row, FollowedSample& out) {
  const int n = model_.joints();
  read_row(segment, row, out);
  const double dt = out.time - last_time_;
  const bool gap = started_ && usual_dt_ > 0.0 && dt > std::max(kGapPeriods * usual_dt_, kLeastGap_s);
  if (!started_ || gap) {
    start(out);
  } else {
    usual_dt_ = usual_dt_ > 0.0 ? usual_dt_ + kPeriodForgetting * (dt - usual_dt_) : dt;
    out.dt = dt;
    for (int j = 0; j < n; ++j) out.pressed[j] = is_pressed(out, j);
    predict(state_, model_, dynamics_, step_to(out, last_torque_, last_torque_missing_), nullptr, 0.0);
    out.total_log_likelihood = 0.0;
    for (int j = 0; j < n; ++j) {
      const JointObservation seen = observe_joint(state_, model_, out, j);
      out.log_likelihood[j] = seen.log_likelihood;
      out.chi_square[j] = seen.chi_square;
      out.whitened[j] = seen.whitened_q;
      out.whitened[n + j] = seen.whitened_dq;
      out.total_log_likelihood += seen.log_likelihood;
    }
  }
  out.posterior = state_;
  last_time_ = out.time;
  last_q_ = out.q;
  last_dq_ = out.dq;
  last_torque_ = out.torque;
  last_torque_missing_ = out.torque_missing;
}

}  // namespace faultline
