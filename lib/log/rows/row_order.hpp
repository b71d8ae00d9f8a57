// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/log/log.hpp"
#include "lib/log/log_run.hpp"

namespace faultline {

/// A row that a recorder wrote late is put in its place if fewer rows than these with later times came before
/// it: recorders with several threads write rows up to a
/// second late, at up to 1 kHz.
inline constexpr int kOrderWindowRows = 1000;

/// Puts the rows of a file in the order of their times, which then strictly increase.
///
/// A row whose time is missing, impossible or repeated is left out, as is one that leaps ahead of rows that
/// never reach it, and one before earlier rows where no row is missing. A row before earlier ones that fits
/// into a hole of the window goes there. Where the clock goes back to times that have rows already, and on
/// from there, another run begins: its rows follow the run before after a gap that every stage takes for one.
/// A time of day that passes midnight goes on. What the result is does not depend on how many rows are taken
/// at a time.
class RowOrder {
 public:
  /// Reads every run, or the one asked for, on its own clock.
  explicit RowOrder(int wanted_run = kEveryRun) : wanted_run_(wanted_run) {}

  /// The next rows of the file; row i is data row first_row + i + 1.
  void take(const Log& rows, std::int64_t first_row, Issues& issues);
  /// After the last row.
  void finish(Issues& issues);
  /// At most `most` rows whose order is settled; false while there are none.
  bool give(Log& segment, int most);
  /// Those that began so far.
  std::vector<LogRun> runs() const;

 private:
  struct Row {
    double time = 0.0;  ///< of all runs, one after the other
    double own = 0.0;   ///< of its run's clock, counted on past midnight
    int at = 0;         ///< in store_
    std::int64_t number = 0;
  };
  struct OwnSpan {
    double start_s = 0.0, end_s = 0.0;
  };
  struct LostRows {
    std::int64_t rows = 0, first = 0;
    double step_s = 0.0;  ///< usual where they were lost
  };

  /// Of a row with an earlier time than the newest one.
  struct Behind {
    std::ptrdiff_t later = 0;  ///< in order_: the first row after it
    bool is_repeated = false;  ///< another row has its time,
    bool is_same = false;      ///< and its values
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
  /// The time in the log of a stamp, which may be late and of the day before the present one.
  double placed(double stamp) const;
  /// Time in the log less time of the present run's clock.
  double clock_shift() const { return offset_ + 86400.0 * midnights_; }
  const LogRun& run_at(double time) const;
  void forget_given();
  void drop_first(std::size_t rows);
  void gather(Log& segment, std::size_t rows) const;
  void tell_lost(Issues& issues) const;

  int wanted_run_;
  Log store_;                          ///< rows as they came
  std::vector<std::int64_t> numbers_;  ///< of the rows in store_, from 1
  int judged_ = 0;                     ///< rows of store_
  std::vector<Row> order_;             ///< by time; those that are not given yet
  std::size_t run_begin_ = 0;          ///< in order_: first row of the present run
  std::vector<Row> early_;             ///< ahead of what follows them, not reached yet
  std::vector<LogRun> runs_;
  std::vector<OwnSpan> own_spans_;                            ///< of the runs, on their own clocks
  double newest_ = -std::numeric_limits<double>::infinity();  ///< of the present run
  double last_step_ = 0.0;
  double offset_ = 0.0;  ///< of the present run's clock
  int midnights_ = 0;    ///< that the present run passed
  LostRows lost_, most_lost_;
  bool finished_ = false;
};

}  // namespace faultline
