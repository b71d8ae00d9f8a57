// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "lib/evidence/filter/follower.hpp"

namespace faultline {

/// The cheap watch over the healthy filter: sums of whitened innovations over windows of several lengths,
/// each over its standard deviation (the square root of the window's length), and runs of repeated encoder
/// codes.
class Trigger {
 public:
  static constexpr std::array<int, 5> kWindows = {1, 4, 16, 64, 256};

  explicit Trigger(const MotionModel& model);

  /// Takes the next sample; returns the largest statistic over channels and windows.
  double take(const FollowedSample& sample);
  /// What was seen so far was explained: the windows begin anew.
  void forget() { restart(); }
  /// Samples in the run of repeated codes of any joint whose encoder does not repeat when healthy; 0 without
  /// one.
  int repeated_codes() const { return longest_run_; }

 private:
  void restart();

  const MotionModel& model_;
  std::vector<double> history_;  ///< ring of whitened innovations, the longest window's rows by channels
  std::array<std::array<double, 2 * kMaxJoints>, 5> sums_{};
  int count_ = 0;  ///< samples since the start
  std::array<int, kMaxJoints> run_{};
  int longest_run_ = 0;
};

/// Repeated codes in a row that raise suspicion, and the longest healthy run below which they mean anything.
inline constexpr int kSuspiciousRepeats = 3;
bool repeats_mean_stuck(const MotionModel& model, int joint);

}  // namespace faultline
