// SPDX-License-Identifier: MIT
#include "lib/residual/relation/lag_line.hpp"

#include <algorithm>
#include <cmath>

#include "lib/log/log_channels.hpp"

namespace faultline {
namespace {

constexpr double kGap = 1.75;    // periods: in a longer step between two rows, a row is missing
constexpr int kMostBridged = 5;  // missing rows in succession that are interpolated, at most

}  // namespace

LagLine::LagLine(const SignalRelation& relation)
    : inputs_(relation.inputs),
      target_(relation.target),
      bridges_(relation.kind == RelationKind::tracking),
      joint_(relation.joint),
      lags_(relation.lags),
      stride_(relation.stride),
      period_s_(relation.period_s),
      rate_limit_(relation.rate_limit),
      before_(inputs_.size() * (lags_ * stride_ + 1)),
      terms_(relation.weights_needed(), 1.0) {}

/// The input as a target with this rate limit follows it, from the present value of the target on.
double LagLine::followed(double input, const Log& log, int row, double dt) {
  if (rate_limit_ <= 0.0) return input;
  const double target = signals_of(log, target_)[joint_][row];
  if (rows_ == 0 || !std::isfinite(followed_)) followed_ = std::isfinite(target) ? target : input;
  const double most = rate_limit_ * std::min(dt, (kMostBridged + 1) * period_s_);
  followed_ += std::clamp(input - followed_, -most, most);
  return followed_;
}

void LagLine::push(std::size_t input, double value) {
  const std::size_t reach = static_cast<std::size_t>(lags_) * stride_;
  double* line = &before_[input * (reach + 1)];
  std::copy_backward(line, line + reach, line + reach + 1);
  line[0] = value;
}

bool LagLine::take(const Log& log, int row) {
  const double dt = log.time[row] - last_s_;
  last_s_ = log.time[row];
  const bool in_step = dt > 0.0 && dt < kGap * period_s_;
  const double lost = in_step || !bridges_ ? 0.0 : std::round(dt / period_s_) - 1.0;
  if (!in_step && !(lost >= 1.0 && lost <= kMostBridged)) rows_ = 0;
  const int bridged = rows_ == 0 ? 0 : static_cast<int>(lost);
  const std::size_t reach = static_cast<std::size_t>(lags_) * stride_, kept = reach + 1;
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    double value = signals_of(log, inputs_[i])[joint_][row];
    if (!std::isfinite(value)) {
      rows_ = 0;
      return false;
    }
    if (i == 0) value = followed(value, log, row, dt);
    const double before = before_[i * kept];
    for (int b = 1; b <= bridged; ++b) push(i, before + (value - before) * b / (bridged + 1));
    push(i, value);
  }
  rows_ += bridged;
  if (++rows_ <= static_cast<int>(reach)) return false;
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const double* line = &before_[i * kept];
    double* terms = &terms_[i * (lags_ + 1)];
    terms[0] = line[0];
    for (int l = 0; l < lags_; ++l) terms[l + 1] = line[l * stride_] - line[(l + 1) * stride_];
  }
  return true;
}

}  // namespace faultline
