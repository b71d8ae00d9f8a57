// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/log/log.hpp"
#include "lib/log/log_run.hpp"

namespace faultline {

/// Finds the stretches of a log in which a joint was judged again and again, but not enough: of ten moments
/// in succession (judged_window_s()) more than a quarter was not judged, in pieces none of which is longer
/// than a moment. In a run shorter than ten moments the limit is a quarter of its length, but at least one
/// moment. JudgedStretches has the longer pieces.
class ThinStretches {
 public:
  /// Takes the next rows, in which single lost rows are empty ones; `runs` are those known so far.
  void take(const Log& segment, const std::vector<LogRun>& runs);
  /// Returns them by start; complete after the last row. Rows without any position are reported as joint 0.
  std::vector<UnjudgedStretch> stretches() const;

 private:
  struct Piece {
    double start_s = 0.0, end_s = 0.0;
    double unjudged_s = 0.0;
    bool lacks_position = false, lacks_torque = false;
  };
  /// The pieces of a joint, or of the rows themselves, that were not judged.
  struct Course {
    double judged_s = 0.0;  ///< last row at which it was judged, or the run's first
    bool lacks_position = false, lacks_torque = false;
    std::deque<Piece> window;  ///< pieces of the latest ten moments
    double window_s = 0.0;     ///< their sum
    Piece stretch;             ///< the latest stretch with too much unjudged time; none if its length is 0
  };

  void begin();
  void take_row(const Log& rows, int row, const std::vector<LogRun>& runs);
  void begin_run(double time_s);
  void end_run();
  void judge(std::size_t course, double time_s, bool is_missing_before);
  void add_piece(std::size_t course, const Piece& piece);
  void settle(std::size_t course);
  void grow(std::size_t course, double enough_s);
  std::vector<UnjudgedStretch> without_doubles() const;

  Log head_;  ///< the first rows, until there are enough to estimate the period
  std::vector<LogRun> head_runs_;
  bool has_begun_ = false;
  double period_s_ = 0.0, moment_s_ = 0.0, width_s_ = 0.0;
  std::vector<Course> courses_;  ///< 0: the rows; then by joint
  std::vector<UnjudgedStretch> found_;
  double run_start_s_ = 0.0, last_s_ = 0.0;
  std::size_t run_ = 0;
};

}  // namespace faultline
