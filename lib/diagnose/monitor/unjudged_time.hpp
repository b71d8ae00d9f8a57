// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/log/log.hpp"
#include "lib/log/time_axis.hpp"

namespace faultline {

/// Finds the stretches of a log in which a joint could not be judged, because its position, its torque (if
/// the log has torque) or whole rows are missing. A stretch counts if it is longer than a moment
/// (judged_moment_s()), or at the end of a run longer than ten samples. A thin stretch, in which single
/// moments are judged, counts if shorter pieces make up more than a quarter of ten moments in succession, in
/// a shorter run a quarter of its length and at least one moment. The time between two runs does not count.
class UnjudgedTime {
 public:
  /// Takes the next rows; `runs` are those known so far.
  void take(const Log& segment, const std::vector<LogRun>& runs);
  /// Returns the stretches by start; complete after the last row. Joint 0 stands for missing rows, and in
  /// thin stretches for rows without any position.
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
    Piece thin;                ///< the latest stretch with too much unjudged time; none if its length is 0

    bool lacks_values() const { return lacks_position || lacks_torque; }
  };

  void begin();
  void take_row(const Log& rows, int row, const std::vector<LogRun>& runs);
  void begin_run(double time_s);
  void end_run();
  void judge(std::size_t course, double time_s, bool is_missing_before);
  void note_long(std::size_t course, double end_s);
  void add_piece(std::size_t course, double end_s);
  void settle(std::size_t course);
  void grow(std::size_t course, double enough_s);

  Log head_;  ///< the first rows, until there are enough to estimate the period
  std::vector<LogRun> head_runs_;
  bool has_begun_ = false;
  double period_s_ = 0.0, moment_s_ = 0.0, width_s_ = 0.0;
  std::vector<Course> courses_;  ///< 0: the rows; then by joint
  std::vector<UnjudgedStretch> long_, thin_;
  double run_start_s_ = 0.0, last_s_ = 0.0;
  std::size_t run_ = 0;
};

}  // namespace faultline
