// SPDX-License-Identifier: MIT
#include "lib/log/velocity_check.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

constexpr double kWindow_s = 0.1;
constexpr int kWindowSamples = 5;
constexpr int kFewestWindows = 5;
/// Least ratio of the motion over a window to its noise for a verdict.
constexpr double kAboveNoise = 10.0;
/// Least motion over a window for a verdict, rad or m: below it lie rounding and drift.
constexpr double kLeastMotion = 1e-4;
constexpr double kFactorTolerance = 1.25;
constexpr double kLowestCorrelation = 0.5;
/// Least correlation of one motion; noise that is kAboveNoise times smaller lowers it to 0.99.
constexpr double kOneMotion = 0.98;
constexpr double kCheckGapSteps = 5.0;  // a longer step is a gap

}  // namespace

bool VelocityAgreement::is_one_motion() const { return std::abs(correlation) > kOneMotion; }

void VelocityCheck::add(const std::vector<double>& time, const std::vector<double>& q,
                        const std::vector<double>& dq) {
  for (std::size_t i = 0; i < time.size(); ++i) add_sample(time[i], q[i], dq[i]);
}

void VelocityCheck::add_sample(double t, double q, double dq) {
  if (std::isnan(q) || std::isnan(dq)) {
    run_ = window_samples_ = 0;
    return;
  }
  const double since = t - last_.t;
  if (run_ > 0 && (!(since > 0.0) || (usual_step_ > 0.0 && since > kCheckGapSteps * usual_step_)))
    run_ = window_samples_ = 0;  // the motion across a gap, or to the row of a raw file before, is unknown
  else if (run_ > 0)
    usual_step_ = usual_step_ > 0.0 ? usual_step_ + 0.05 * (since - usual_step_) : since;
  const Sample now{t, q, dq};
  if (run_ > 0 && window_samples_ > 0) {
    integral_ += 0.5 * (dq + last_.dq) * (t - last_.t);
    if (run_ > 1) {
      const double dt = t - last_.t;
      const double bend = q - 2.0 * last_.q + before_last_.q;
      const double velocity_bend = (dq - 2.0 * last_.dq + before_last_.dq) * dt;
      q_noise_ += bend * bend;
      integral_noise_ += velocity_bend * velocity_bend;
      ++differences_;
    }
    ++window_samples_;
    if (t - window_start_ >= kWindow_s && window_samples_ > kWindowSamples) {
      const double change = q - window_q_;
      xx_ += integral_ * integral_;
      xy_ += integral_ * change;
      yy_ += change * change;
      ++windows_;
      window_samples_ = 0;
    }
  }
  if (window_samples_ == 0) {
    window_start_ = t, window_q_ = q, integral_ = 0.0;
    window_samples_ = 1;
  }
  before_last_ = last_;
  last_ = now;
  ++run_;
}

VelocityAgreement VelocityCheck::result() const {
  VelocityAgreement agreement;
  if (windows_ < kFewestWindows || differences_ == 0) return agreement;
  const double windows = static_cast<double>(windows_), differences = static_cast<double>(differences_);
  // White noise of variance s has second differences of variance 6 s.
  const double q_noise = 2.0 * q_noise_ / differences / 6.0;
  const double integral_noise = kWindowSamples * integral_noise_ / differences / 6.0;
  const double least = kAboveNoise * kAboveNoise;
  const bool q_moves = yy_ / windows > std::max(least * q_noise, kLeastMotion * kLeastMotion);
  const bool dq_moves = xx_ / windows > std::max(least * integral_noise, kLeastMotion * kLeastMotion);
  if (!q_moves && !dq_moves) return agreement;
  agreement.correlation = xx_ > 0.0 && yy_ > 0.0 ? xy_ / std::sqrt(xx_ * yy_) : 0.0;
  agreement.factor = xx_ > 0.0 ? xy_ / xx_ : 0.0;
  if (xx_ > 0.0)
    agreement.factor_std = std::sqrt(std::max(yy_ - agreement.factor * xy_, 0.0) / xx_ / (windows - 1.0));
  const double size = std::abs(agreement.factor);
  if (std::abs(agreement.correlation) < kLowestCorrelation)
    agreement.verdict = VelocityVerdict::contradicts;
  else if (agreement.factor < 0.0 || size > kFactorTolerance || size < 1.0 / kFactorTolerance)
    agreement.verdict = VelocityVerdict::scaled;
  else
    agreement.verdict = VelocityVerdict::agrees;
  return agreement;
}

}  // namespace faultline
