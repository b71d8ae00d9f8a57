// SPDX-License-Identifier: MIT
#include "lib/residual/relation/lag_line.hpp"

#include <algorithm>
#include <cmath>

#include "lib/log/log_channels.hpp"

namespace faultline {
namespace {

constexpr double kGap = 1.75;  // periods from one row to the next: farther, a row is missing between them

}  // namespace

LagLine::LagLine(const SignalRelation& relation)
    : inputs_(relation.inputs),
      joint_(relation.joint),
      lags_(relation.lags),
      period_s_(relation.period_s),
      before_(inputs_.size() * (lags_ + 1)),
      terms_(relation.weights_needed(), 1.0) {}

bool LagLine::take(const Log& log, int row) {
  const double dt = log.time[row] - last_s_;
  last_s_ = log.time[row];
  if (!(dt > 0.0 && dt < kGap * period_s_)) rows_ = 0;
  const std::size_t kept = lags_ + 1;
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    double* line = &before_[i * kept];
    std::copy_backward(line, line + lags_, line + kept);
    line[0] = signals_of(log, inputs_[i])[joint_][row];
    if (!std::isfinite(line[0])) {
      rows_ = 0;
      return false;
    }
  }
  if (++rows_ <= lags_) return false;
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const double* line = &before_[i * kept];
    terms_[i * kept] = line[0];
    for (int l = 0; l < lags_; ++l) terms_[i * kept + l + 1] = line[l] - line[l + 1];
  }
  return true;
}

}  // namespace faultline
