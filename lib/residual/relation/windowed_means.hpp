// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <span>
#include <vector>

namespace faultline {

/// Lengths over which residuals are averaged, s: shorter ones show each transient of a current loop.
inline constexpr double kRelationWindows_s[] = {0.1, 0.2, 0.4, 0.8, 1.6};

/// Means of a series of samples over its latest windows.
class WindowedMeans {
 public:
  /// `rows`: length of each window, at least 1, the shortest first.
  explicit WindowedMeans(std::vector<int> rows);

  /// Adds a sample. A pause of more than a fifth of a second interrupts the series: all windows begin anew.
  void add(double value, double time_s);
  void restart();
  /// Number of windows that are full; these are the shortest ones.
  int full() const;
  double mean(int window) const { return sum_[window] / rows_[window]; }
  int rows(int window) const { return rows_[window]; }

 private:
  std::vector<int> rows_;
  std::vector<double> ring_;  ///< the latest values of the longest window
  std::vector<double> sum_;   ///< by window
  std::size_t next_ = 0;      ///< index of the next value in ring_
  long long count_ = 0;
  double last_s_ = -std::numeric_limits<double>::infinity();
};

/// Returns the rows of each window at that period, at least one each.
std::vector<int> window_rows(std::span<const double> windows_s, double period_s);

}  // namespace faultline
