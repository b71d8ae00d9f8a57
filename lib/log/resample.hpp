// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lib/log/transformed/changed_source.hpp"

namespace faultline {

struct ResampleOptions {
  double period_s = 0.001;  ///< between the new rows, which start at the first recorded time
  double longest_gap_s =
      0.0;  ///< a longer recorded step is a gap without rows; 0 = 3 times the longer of both periods
  /// Torque between two samples: held (0) to a straight line (0.5), see MotionModel::torque_phi.
  double torque_phi = 0.0;
};

/// A log at a fixed sample period, as a slower recorder would have written it: positions, velocities and
/// extra channels are interpolated linearly between neighbouring samples. A torque is its mean over one new
/// period, which keeps the impulse from row to row, so that no short torque is lost or counted twice. A value
/// is missing if one of its inputs is. No rows are made inside gaps or beyond the last sample. `rows_read`
/// and the issues are those of the recorded log.
class ResampledSource : public ChangedSource {
 public:
  /// Throws Error(usage) unless the period is positive.
  ResampledSource(LogSource& source, const ResampleOptions& options);

  bool next(Log& segment) override;
  void rewind() override;

 private:
  /// A new row: `share` of the way from recorded row `left` to the next one.
  struct NewRow {
    double time = 0.0;
    int left = 0;
    double share = 0.0;
  };

  void place_rows();
  void place_between(int left);
  void make(Log& segment) const;
  double mean_torque(const std::vector<double>& tau, const NewRow& row) const;
  void forget_old_rows();
  double next_time() const { return start_ + static_cast<double>(step_) * options_.period_s; }
  double after() const { return (1.0 - options_.torque_phi) * options_.period_s; }
  double before() const { return options_.torque_phi * options_.period_s; }
  bool is_gap(double span) const;

  ResampleOptions options_;
  Log incoming_;
  Log recorded_;              ///< rows that new ones may still need
  std::vector<bool> gap_;     ///< for each recorded row: whether a gap follows it
  std::vector<NewRow> rows_;  ///< new rows of the present segment
  int placed_ = 0;            ///< recorded rows for which the new rows up to the next one are made
  bool at_end_ = false;
  double start_ = 0.0;
  double usual_ = 0.0;      ///< last recorded step that was no gap
  std::int64_t step_ = -1;  ///< grid index of the next new row; -1 before the first
  std::int64_t made_ = 0;
};

}  // namespace faultline
