// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/log/log.hpp"
#include "lib/log/log_run.hpp"

namespace faultline {

/// Follows a log for the stretches in which a joint was judged again and again, but not enough: of ten
/// moments in succession (judged_window_s()) more than a quarter was not judged, in pieces none of which is
/// longer than a moment. Of a run that is shorter, a quarter of it counts, and more than a moment.
/// JudgedStretches has the longer pieces.
class ThinStretches {
 public:
  /// The next rows, where single lost rows stand as empty ones; `runs` are those known so far.
  void take(const Log& segment, const std::vector<LogRun>& runs);
  /// By start; complete after the last row. A row without any position counts for no joint (0).
  std::vector<UnjudgedStretch> stretches() const;

 private:
  struct Piece {
    double start_s = 0.0, end_s = 0.0;
    double unjudged_s = 0.0;
    bool lacks_position = false, lacks_torque = false;
  };
  /// What was not judged of a joint, or of the rows themselves.
  struct Course {
    double judged_s = 0.0;  ///< last row at which it was, or the run's first
    bool lacks_position = false, lacks_torque = false;
    std::deque<Piece> window;  ///< pieces of the latest ten moments
    double window_s = 0.0;     ///< their sum
    Piece stretch;             ///< the latest one that is too thin; empty where it has no length
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

  Log head_;  ///< the first rows, until there are enough to tell the period
  std::vector<LogRun> head_runs_;
  bool has_begun_ = false;
  double period_s_ = 0.0, moment_s_ = 0.0, width_s_ = 0.0;
  std::vector<Course> courses_;  ///< 0: the rows; then by joint
  std::vector<UnjudgedStretch> found_;
  double run_start_s_ = 0.0, last_s_ = 0.0;
  std::size_t run_ = 0;
};

}  // namespace faultline
