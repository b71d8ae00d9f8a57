// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace faultline {

/// A lasting change of the sample period of a log.
struct PeriodChange {
  double at_s = 0.0;
  std::int64_t row = 0;  ///< about; the row before the first step of the new period, from 1
  double before_s = 0.0, after_s = 0.0;
};

/// Detects lasting changes of the sample period: over many steps, not by gaps or jitter.
class ClockCheck {
 public:
  void add(double t);
  /// Returns the first hundred changes.
  const std::vector<PeriodChange>& changes() const { return changes_; }

 private:
  /// Successive steps.
  struct Block {
    double start_s = 0.0;
    std::int64_t row = 0;
    double period_s = 0.0;  ///< mean of the steps without the shortest and longest
  };
  void close_block();

  std::int64_t rows_ = 0;
  double last_s_ = 0.0;
  std::vector<double> steps_;
  Block block_;
  double usual_s_ = 0.0;      ///< period so far, 0 if unknown
  std::vector<Block> other_;  ///< successive blocks with another period
  std::vector<PeriodChange> changes_;
};

}  // namespace faultline
