// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/log/log.hpp"
#include "lib/log/time_axis.hpp"

namespace faultline {

/// Limit of magnitude that no joint signal or time in SI reaches; a number beyond it is damage.
inline constexpr double kImplausible = 1e12;

/// Replaces infinite or implausible values by NaN and adds an issue for each. Row i of the segment is data
/// row first_row + i + 1 of the file.
void blank_implausible(Log& segment, std::int64_t first_row, Issues& issues);

/// A late row is put in its place if fewer than this number of rows with later times come before it in the
/// file: recorders with several threads write rows up to a second late, at up to 1 kHz.
inline constexpr int kOrderWindowRows = 1000;

/// Puts the rows of a file in the order of their times, which then strictly increase.
///
/// Left out are a row whose time is missing, impossible or repeated, one that leaps ahead and is never
/// reached by later rows, and one that comes after later rows although no row is missing at its time. A late
/// row that fits into a hole of the window goes there. If the clock goes back to times that have rows
/// already, and on from there, another run begins: its rows follow the run before after a step that every
/// stage treats as a gap. A time of day that passes midnight is continued. The result does not depend on how
/// many rows are taken at a time.
class RowOrder {
 public:
  /// Reads every run, or only the requested one, on its own clock.
  explicit RowOrder(int wanted_run = kEveryRun) : wanted_run_(wanted_run) {}

  /// Takes the next rows of the file; row i is data row first_row + i + 1.
  void take(const Log& rows, std::int64_t first_row, Issues& issues);
  /// To be called after the last row.
  void finish(Issues& issues);
  /// Hands out at most `most` rows whose order is settled; returns false if there are none.
  bool give(Log& segment, int most);
  /// Returns the runs that have begun so far.
  std::vector<LogRun> runs() const;

 private:
  struct Row {
    double time = 0.0;  ///< with all runs one after the other
    double own = 0.0;   ///< on the clock of its run, continued past midnight
    int at = 0;         ///< index in store_
    std::int64_t number = 0;
  };
  struct OwnSpan {
    double start_s = 0.0, end_s = 0.0;
  };
  struct LostRows {
    std::int64_t rows = 0, first = 0;
    double step_s = 0.0;  ///< usual step at the lost rows
  };

  /// Place of a row whose time is not later than the newest one.
  struct Behind {
    std::ptrdiff_t later = 0;  ///< index in order_ of the first row after it
    bool is_repeated = false;  ///< another row has the same time,
    bool is_same = false;      ///< and the same values
    bool is_far = false;
    bool fits = false;  ///< a row is missing there
  };

  bool is_simply_next(int at);
  void judge(int at, double next, Issues& issues);
  void take_ahead(const Row& row, double next, Issues& issues);
  void take_behind(const Row& row, double next, Issues& issues);
  Behind behind(const Row& row) const;
  bool passes_midnight(const Row& row) const;
  void pass_midnight(Row row, Issues& issues);
  void begin_run(Row row, Issues& issues);
  void add_run(const LogRun& run);
  void end_run(Issues& issues);
  void advance(const Row& row, Issues& issues);
  void place(const Row& row, std::ptrdiff_t where, Issues& issues);
  void place_early(Issues& issues);
  void give_up_early(std::int64_t before, Issues& issues);
  void leave_out(const std::string& code, const Row& row, Issues& issues);
  bool is_same_row(int a, int b) const;
  bool is_wanted(int run) const { return wanted_run_ == kEveryRun || wanted_run_ == run; }
  double usual_step() const;
  /// Returns the time in the log of a stamp, which may be late and from the day before the present one.
  double placed(double stamp) const;
  /// Time in the log minus time of the present run's clock.
  double clock_shift() const { return offset_ + 86400.0 * midnights_; }
  const LogRun& run_at(double time) const;
  void forget_given();
  void drop_first(std::size_t rows);
  void gather(Log& segment, std::size_t rows) const;
  void report_lost(Issues& issues) const;

  int wanted_run_;
  Log store_;                          ///< rows in the order of the file
  std::vector<std::int64_t> numbers_;  ///< of the rows in store_, from 1
  int judged_ = 0;                     ///< rows of store_ that were judged
  std::vector<Row> order_;             ///< by time; rows not handed out yet
  std::size_t run_begin_ = 0;          ///< in order_: first row of the present run
  std::vector<Row> early_;             ///< rows that leap ahead of the following ones, not reached yet
  std::vector<LogRun> runs_;
  std::vector<OwnSpan> own_spans_;                            ///< of the runs, on their own clocks
  double newest_ = -std::numeric_limits<double>::infinity();  ///< of the present run
  double last_step_ = 0.0;
  double offset_ = 0.0;  ///< of the present run's clock
  int midnights_ = 0;    ///< midnights that the present run has passed
  LostRows lost_, most_lost_;
  bool finished_ = false;
};

}  // namespace faultline
