// SPDX-License-Identifier: MIT
#include "lib/plausibility/checkup/clock_check.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace faultline {
namespace {

constexpr std::size_t kBlockSteps = 64;
constexpr std::ptrdiff_t kTrimmed = 8;  // at each end
constexpr std::size_t kBlocksForGood = 3;
constexpr double kOther = 0.2;      // relative, of a period from the usual one
constexpr double kSamePace = 0.05;  // relative, of the new periods from each other
constexpr double kAdaption = 0.1;
constexpr std::size_t kMostChanges = 100;

bool differs(double a, double b, double share) { return std::abs(a - b) > share * b; }

}  // namespace

void ClockCheck::add(double t) {
  if (rows_++ > 0) {
    if (steps_.empty()) block_ = {last_s_, rows_ - 1, 0.0};
    steps_.push_back(t - last_s_);
    if (steps_.size() == kBlockSteps) close_block();
  }
  last_s_ = t;
}

void ClockCheck::close_block() {
  std::sort(steps_.begin(), steps_.end());
  block_.period_s = std::accumulate(steps_.begin() + kTrimmed, steps_.end() - kTrimmed, 0.0) /
                    static_cast<double>(kBlockSteps - 2 * kTrimmed);
  steps_.clear();
  if (usual_s_ == 0.0) usual_s_ = block_.period_s;
  if (!differs(block_.period_s, usual_s_, kOther)) {
    usual_s_ += kAdaption * (block_.period_s - usual_s_);
    other_.clear();
    return;
  }
  // The block in which the period changes has steps of both periods.
  if (other_.size() > 1 && differs(block_.period_s, other_.back().period_s, kSamePace)) other_.clear();
  other_.push_back(block_);
  if (other_.size() <= kBlocksForGood) return;
  if (changes_.size() < kMostChanges)
    changes_.push_back({other_.front().start_s, other_.front().row, usual_s_, block_.period_s});
  usual_s_ = block_.period_s;
  other_.clear();
}

}  // namespace faultline
