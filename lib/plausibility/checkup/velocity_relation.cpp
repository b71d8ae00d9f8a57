// SPDX-License-Identifier: MIT
#include "lib/plausibility/checkup/velocity_relation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/plausibility/checkup/valley.hpp"

namespace faultline {
namespace {

constexpr std::int64_t kRelationFewestRows = 100;
constexpr double kLeastRms = 1e-3;        // rad/s or m/s; below it the joint rests
constexpr double kRoughest = 0.2;         // limit of the noise share in squared slopes of a moving joint
constexpr double kSameNoise = 0.04;       // of the slopes' mean square noise: limit for a difference
constexpr double kAboveRoughness = 20.0;  // least ratio of motion to noise, in squares, to estimate a delay
constexpr double kSimilar = 1.25;         // largest rms ratio to estimate a delay
/// White noise of variance s has second differences of variance 6 s.
constexpr double kBend = 6.0;

}  // namespace

void VelocityRelation::add(double t, double q, double dq) {
  if (std::isnan(q) || std::isnan(dq)) {
    run_ = 0;
    return;
  }
  if (run_ > 0 && t - t_ > gap_s_) run_ = 0;
  if (run_ > 0) {
    std::copy_backward(slopes_.begin(), slopes_.end() - 1, slopes_.end());
    std::copy_backward(velocities_.begin(), velocities_.end() - 1, velocities_.end());
    std::copy_backward(steps_.begin(), steps_.end() - 1, steps_.end());
    slopes_[0] = (q - q_) / (t - t_);
    steps_[0] = q - q_;
    velocities_[0] = dq;
    if (run_ >= kDelays) compare();
  }
  t_ = t;
  q_ = q;
  ++run_;
}

void VelocityRelation::compare() {
  ++count_;
  const double dq = velocities_[kMostRows], slope = slopes_[kMostRows], after = slopes_[kMostRows - 1];
  velocity_squares_ += dq * dq;
  slope_squares_ += slope * slope;
  product_ += dq * slope;
  const double bend = after - 2.0 * slope + slopes_[kMostRows + 1];
  roughness_ += bend * bend / kBend;
  for (int i = 0; i < kDelays; ++i) off_[i] += (dq - slopes_[i]) * (dq - slopes_[i]);
  const double centred = dq - 0.5 * (slope + after);
  off_centred_ += centred * centred;
  const double step = steps_[kMostRows], next = steps_[kMostRows - 1], last = steps_[kMostRows + 1];
  step_roughness_ += (next - 2.0 * step + last) * (next - 2.0 * step + last) / kBend;
  for (const auto& [at, value] : {std::pair{0, step}, {1, 0.5 * (step + next)}}) {
    step_squares_[at] += value * value;
    step_products_[at] += value * dq;
  }
}

/// Whether the velocity is a multiple of the steps of position, with their noise.
bool VelocityRelation::is_of_steps() const {
  for (std::size_t i = 0; i < step_squares_.size(); ++i) {
    if (!(step_squares_[i] > 0.0)) continue;
    const double factor = step_products_[i] / step_squares_[i];
    const double off = velocity_squares_ - factor * step_products_[i];
    if (step_roughness_ > 0.0 && off < kSameNoise * factor * factor * step_roughness_) return true;
  }
  return false;
}

VelocityRelated VelocityRelation::result() const {
  VelocityRelated related;
  if (count_ < kRelationFewestRows) return related;
  related.rms = std::sqrt(velocity_squares_ / static_cast<double>(count_));
  const double slope_rms = std::sqrt(slope_squares_ / static_cast<double>(count_));
  const bool moves = slope_rms > kLeastRms && roughness_ < kRoughest * slope_squares_;
  if (related.rms < kLeastRms && !moves) return related;
  if (slope_squares_ > 0.0) {
    related.rms_ratio = std::sqrt(velocity_squares_ / slope_squares_);
    related.noise_share = roughness_ / slope_squares_;
  }
  if (related.rms < kLeastRms) return related;
  const double least = std::min(off_centred_, *std::min_element(off_.begin(), off_.end()));
  related.is_difference = (roughness_ > 0.0 && least < kSameNoise * roughness_) || is_of_steps();
  const bool alike = related.rms_ratio < kSimilar && related.rms_ratio > 1.0 / kSimilar;
  if (alike && product_ > kAboveRoughness * roughness_)
    related.delay_rows = valley_of(off_) - kMostRows + 0.5;  // a slope belongs to a time half a row earlier
  return related;
}

}  // namespace faultline
