// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "lib/log/recorder/measured_rows.hpp"
#include "lib/log/transformed/changed_source.hpp"

namespace faultline {

/// Unwraps the angle of one joint that a recorder keeps within one turn (-pi to pi or 0 to 2 pi).
class WrappedAngle {
 public:
  /// Returns the unwrapped angle, rad. If `dq` is missing (NaN), the last step predicts this one, provided
  /// that it was a small part of a turn. After a step longer than `longest_s` the path is unknown, and the
  /// number of turns stays.
  double unwrapped(double t, double q, double dq, double longest_s);
  /// Whether the last angle crossed a border of the turn.
  bool has_wrapped() const { return has_wrapped_; }

 private:
  bool begun_ = false, has_wrapped_ = false;
  double t_ = 0.0, q_ = 0.0, dq_ = 0.0;  ///< of the row before, as recorded
  double turns_ = 0.0;
  double step_ = std::numeric_limits<double>::quiet_NaN();  ///< the last one
};

/// Code of the issue that the columns of a log change their meaning at a row.
inline constexpr const char* kChangedColumns = "columns_changed";

/// A log without the effects of its recorder, if the log itself proves them:
/// - an angle that was kept within one turn is continued beyond it (angle_unwrapped);
/// - rows in which the recorder stood still or wrote zeros lose their values (recorder_stopped, rows_blank);
/// - if two or more joints jump at once, further than their velocities allow, rows are missing or repeated:
///   the repeated ones, or the first few after the jump, are left out, so that the log has a gap there and no
///   stage draws conclusions across it (rows_cut_out, block_repeated);
/// - if two joints continue as each other, columns_changed names the row.
/// A jump, a standstill or zeros of a single joint have no such effect: its sensor may be faulty.
class CorrectedSource : public ChangedSource {
 public:
  /// `slides`: whether each joint slides and so has no turns; empty if unknown. `source` outlives this.
  explicit CorrectedSource(LogSource& source, std::vector<bool> slides = {});
  explicit CorrectedSource(std::unique_ptr<LogSource> source, std::vector<bool> slides = {});

  bool next(Log& segment) override;
  void rewind() override;
  const Issues& issues() const override;

 private:
  void judge_rows();
  void settle(int row);
  void empty_row(int row, const char* code, const std::string& what);
  bool is_in_cut();
  void begin_cut(int row, const std::vector<int>& jumped, std::int64_t earlier);
  void end_cut();
  void unwrap(int row);
  void take_usual_step(double t);
  void hand_out(Log& segment);
  std::int64_t number_of(int row) const { return rows_.first_row + row + 1; }

  std::vector<bool> slides_;

  Log rows_;               ///< rows not handed out yet; first_row as in the source
  int looked_at_ = 0;      ///< number of these for which the recorder's state is known
  int settled_ = 0;        ///< number of these that are kept or left out for good
  std::vector<int> kept_;  ///< settled rows that are kept
  std::int64_t handed_out_ = 0;

  StoppedRecorder recorder_;
  PositionJumps jumps_;
  RowMemory memory_;
  std::vector<WrappedAngle> angles_, references_;
  MeasuredRow row_;
  double last_t_ = std::numeric_limits<double>::quiet_NaN();  ///< time of the row before
  double usual_step_ = 0.0;

  /// Rows that are left out after a jump, because rows before them are missing or repeated.
  struct RowCut {
    std::int64_t row = 0;  ///< first one, from 1; 0 for no break
    double t = 0.0;
    std::int64_t rows = 0;
    std::int64_t again = -1;  ///< row, from 0, that the next one repeats if this is a repeated block
    std::int64_t copies = 0;
    std::string joints;
  };
  RowCut row_cut_;
  Issues corrections_;
  mutable Issues issues_;
};

/// Returns the source, corrected, without values that the recorder did not measure (StoppedColumnsSource).
std::unique_ptr<LogSource> mended(std::unique_ptr<LogSource> source, std::vector<bool> slides = {});

}  // namespace faultline
