// SPDX-License-Identifier: MIT
#include "lib/residual/relation/windowed_means.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

constexpr double kPause_s = 0.2;

}  // namespace

WindowedMeans::WindowedMeans(std::vector<int> rows)
    : rows_(std::move(rows)), ring_(rows_.back()), sum_(rows_.size()) {}

void WindowedMeans::add(double value, double time_s) {
  if (time_s - last_s_ > kPause_s) restart();
  last_s_ = time_s;
  for (std::size_t w = 0; w < rows_.size(); ++w) {
    const std::size_t size = ring_.size();
    sum_[w] += value;
    if (count_ >= rows_[w]) sum_[w] -= ring_[(next_ + size - rows_[w]) % size];
  }
  ring_[next_] = value;
  next_ = (next_ + 1) % ring_.size();
  ++count_;
  if (next_ != 0) return;  // once a round the sums are recomputed, so that rounding errors do not add up
  for (std::size_t w = 0; w < rows_.size(); ++w) {
    sum_[w] = 0.0;
    for (int k = 1; k <= std::min<long long>(rows_[w], count_); ++k) sum_[w] += ring_[ring_.size() - k];
  }
}

void WindowedMeans::restart() {
  std::fill(sum_.begin(), sum_.end(), 0.0);
  next_ = 0;
  count_ = 0;
}

int WindowedMeans::full() const {
  return static_cast<int>(
      std::count_if(rows_.begin(), rows_.end(), [&](int rows) { return count_ >= rows; }));
}

std::vector<int> window_rows(std::span<const double> windows_s, double period_s) {
  std::vector<int> rows;
  for (const double window_s : windows_s)
    rows.push_back(std::max(1, static_cast<int>(std::lround(window_s / period_s))));
  return rows;
}

}  // namespace faultline
