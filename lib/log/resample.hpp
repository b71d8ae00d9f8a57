// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lib/log/log_source.hpp"

namespace faultline {

struct ResampleOptions {
  double period_s = 0.001;  ///< of the new rows, which start at the first recorded time
  double longest_gap_s =
      0.0;  ///< no rows are made between samples further apart; 0 = 3 periods of either log
  /// How a torque runs to the next one: held (0) to a straight line (0.5), see MotionModel::torque_phi.
  double torque_phi = 0.0;
};

/// A log at a fixed sample period, as a slower recorder would have written it: positions, velocities and
/// extra channels are those of the moment, on a straight line between neighbouring samples. A torque is what
/// must be logged for the same impulse from row to row, that is its mean over one new period; so no short
/// torque is lost or counted twice. A value is missing where one that it needs is. Rows are neither made
/// inside gaps nor beyond the last sample. `rows_read` and the issues stay those of the recorded log.
class ResampledSource : public LogSource {
 public:
  /// `source` stands at its first row and is read by nobody else; it outlives this. Throws Error(usage)
  /// unless the period is positive.
  ResampledSource(LogSource& source, const ResampleOptions& options);
  /// The same, keeping the source.
  ResampledSource(std::unique_ptr<LogSource> source, const ResampleOptions& options);

  bool next(Log& segment) override;
  void rewind() override;
  const LogIdentity& identity() const override { return source_.identity(); }
  const Issues& issues() const override { return source_.issues(); }
  double share_read() const override { return source_.share_read(); }

 private:
  /// A new row: `share` of the way from recorded row `left` to the one after it.
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

  std::unique_ptr<LogSource> owned_;
  LogSource& source_;
  ResampleOptions options_;
  Log incoming_;
  Log recorded_;              ///< rows that new ones may still need
  std::vector<bool> gap_;     ///< by recorded row: whether nothing is known up to the one after it
  std::vector<NewRow> rows_;  ///< of the present segment
  int placed_ = 0;            ///< recorded rows whose way to the next one has its new rows
  bool at_end_ = false;
  double start_ = 0.0;
  double usual_ = 0.0;      ///< last recorded step that was no gap
  std::int64_t step_ = -1;  ///< of the next new row on the grid; -1 before the first
  std::int64_t made_ = 0;
};

}  // namespace faultline
