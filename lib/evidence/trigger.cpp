// SPDX-License-Identifier: MIT
#include "lib/evidence/trigger.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {

bool repeats_mean_stuck(const MotionModel& model, int joint) {
  return model.longest_repeat[joint] < kSuspiciousRepeats - 1;
}

Trigger::Trigger(const MotionModel& model)
    : model_(model), history_(kWindows.back() * 2 * model.joints(), 0.0) {}

void Trigger::restart() {
  std::fill(history_.begin(), history_.end(), 0.0);
  for (auto& sums : sums_) sums.fill(0.0);
  count_ = 0;
  run_.fill(0);
}

double Trigger::take(const FollowedSample& sample) {
  if (sample.dt <= 0.0) restart();
  const int channels = 2 * model_.joints(), longest = kWindows.back();
  double largest = 0.0;
  for (std::size_t w = 0; w < kWindows.size(); ++w) {
    const double* leaving = &history_[((count_ + longest - kWindows[w]) % longest) * channels];
    const double scale = 1.0 / std::sqrt(static_cast<double>(kWindows[w]));
    for (int c = 0; c < channels; ++c) {
      sums_[w][c] += sample.whitened[c] - leaving[c];
      largest = std::max(largest, std::abs(sums_[w][c]) * scale);
    }
  }
  std::copy_n(sample.whitened.begin(), channels, &history_[(count_ % longest) * channels]);
  ++count_;
  longest_run_ = 0;
  for (int j = 0; j < model_.joints(); ++j) {
    run_[j] = sample.repeats[j] ? run_[j] + 1 : 0;
    if (repeats_mean_stuck(model_, j)) longest_run_ = std::max(longest_run_, run_[j]);
  }
  return largest;
}

}  // namespace faultline
