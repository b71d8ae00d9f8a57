// SPDX-License-Identifier: MIT
#include "lib/evidence/learn/innovation_tails.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/core/parallel.hpp"
#include "lib/core/statistics.hpp"
#include "lib/evidence/filter/follower.hpp"

namespace faultline {
namespace {

constexpr double kRareShare = 0.999;  // of the innovations: a normal one stays within 3.3 of them
constexpr double kStrays = 4.2;       // standard deviations of that rare one: no normal distribution
constexpr double kTail = 3.0;         // standard deviations that then count in full
constexpr double kFarTail = 1e6;      // in models, whose JSON has no infinity
constexpr double kFirstJump = 0.05;   // of the largest torque: moves a spring by the sensor's noise, at first
constexpr double kLeastTorque = 1e-9;  // N m or N
constexpr int kSettlingRows = 10;

using Channels = std::array<std::vector<double>, 2 * kMaxJoints>;

Channels innovations(const MotionModel& model, const HealthyExcerpt& excerpt) {
  Channels out;
  Follower follower(model, excerpt.noise);
  FollowedSample sample;
  for (int k = 0; k < excerpt.log.rows(); ++k) {
    follower.follow(excerpt.log, k, sample);
    if (k < kSettlingRows) continue;
    for (int c = 0; c < 2 * model.joints(); ++c)
      if (sample.whitened[c] != 0.0) out[c].push_back(std::abs(sample.whitened[c]));
  }
  return out;
}

}  // namespace

bool learn_tails(MotionModel& model, const std::vector<HealthyExcerpt>& excerpts, int threads) {
  std::vector<Channels> parts(excerpts.size());
  parallel_for(static_cast<int>(excerpts.size()), threads,
               [&](int i) { parts[i] = innovations(model, excerpts[i]); });
  const int n = model.joints();
  bool any = false;
  auto tail_of = [&](int channel) {
    std::vector<double> all;
    for (const Channels& part : parts) all.insert(all.end(), part[channel].begin(), part[channel].end());
    const bool strays = !all.empty() && lower_quantile(all, kRareShare) > kStrays;
    any = any || strays;
    return strays ? kTail : kFarTail;
  };
  for (int j = 0; j < n; ++j) {
    const double velocity = tail_of(n + j), position = tail_of(j);
    model.dq_tail.push_back(velocity);
    model.q_tail.push_back(std::min(velocity, position));  // what shakes a velocity moves the position
  }
  if (any) {
    for (int j = 0; j < n; ++j)
      model.noise.compliance.push_back(model.q_std[j] /
                                       (kFirstJump * std::max(model.torque_scale[j], kLeastTorque)));
  }
  return any;
}

}  // namespace faultline
