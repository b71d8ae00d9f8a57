// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/filter_watch.hpp"

#include <algorithm>

#include "lib/reproduce/filter/bank.hpp"

namespace faultline {
namespace {

std::vector<Hypothesis> free_joints(int joints) {
  std::vector<Hypothesis> bank;
  for (int j = 1; j <= joints; ++j) bank.push_back({.label = {FaultKind::free_swinging, j}});
  return bank;
}

/// The alarms of one threshold.
class Threshold {
 public:
  Threshold(double value, double name_s) : value_(value), name_s_(name_s) {}

  void take(double time_s, double sum, int largest) {
    if (!open_ && sum >= value_) {
      open_ = true;
      alarms.push_back({time_s, {}});
    }
    if (sum <= 0.0) open_ = false;
    if (alarms.empty() || time_s > alarms.back().time_s + name_s_) return;
    if (sum > 0.0) alarms.back().label = {FaultKind::free_swinging, largest + 1};
  }

  Alarms alarms;

 private:
  double value_, name_s_;
  bool open_ = false;
};

/// The sums of all hypotheses one sample on. A filter restarts when its sum falls to zero.
void step(const Bank& bank, std::vector<RunningHypothesis>& running, bool started,
          const FollowedSample& before, const FollowedSample& at) {
  for (int h = 0; h < static_cast<int>(running.size()); ++h) {
    if (started && running[h].log_likelihood_ratio > 0.0)
      bank.advance(running[h], before, at);
    else
      running[h] = bank.start(h, 1, before, at);
  }
}

int largest_of(const std::vector<RunningHypothesis>& running) {
  int largest = 0;
  for (int h = 0; h < static_cast<int>(running.size()); ++h)
    if (running[h].log_likelihood_ratio > running[largest].log_likelihood_ratio) largest = h;
  return largest;
}

}  // namespace

std::vector<Alarms> watch_free_joints(const MotionModel& model, const Log& log, const WatchOptions& options) {
  const std::vector<Hypothesis> hypotheses = free_joints(model.joints());
  Follower follower(model);
  const Bank bank(model, follower.dynamics(), hypotheses);
  std::vector<RunningHypothesis> running(hypotheses.size());
  std::vector<Threshold> thresholds;
  for (const double value : options.thresholds) thresholds.emplace_back(value, options.name_s);
  FollowedSample samples[2];
  for (int k = 0; k < log.rows(); ++k) {
    const FollowedSample& before = samples[(k + 1) % 2];
    FollowedSample& at = samples[k % 2];
    follower.follow(log, k, at);
    if (at.dt <= 0.0) continue;
    step(bank, running, k > 1, before, at);
    const int largest = largest_of(running);
    const double sum = std::max(running[largest].log_likelihood_ratio, 0.0);
    for (Threshold& threshold : thresholds) threshold.take(at.time, sum, largest);
  }
  std::vector<Alarms> alarms;
  for (Threshold& threshold : thresholds) alarms.push_back(std::move(threshold.alarms));
  return alarms;
}

}  // namespace faultline
