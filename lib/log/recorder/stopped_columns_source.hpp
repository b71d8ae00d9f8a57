// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "lib/log/log.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// The columns of a log that a recorder reads together.
enum class ColumnGroup { positions, velocities, torques };
inline constexpr int kColumnGroups = 3;

/// A group of which every joint keeps all digits from one row to the next.
struct ColumnHold {
  std::int64_t first_row = 0;  ///< from 0: the one that the others repeat
  std::int64_t repeats = 0;    ///< rows after it
  bool is_zero = false;        ///< all of its values are exactly zero
  bool stopped = false;        ///< the other columns contradict it: these rows were not measured
  bool decided = false;        ///< stays as it is until the hold ends
};

/// Finds groups of columns in which the recorder stood still, or wrote zeros, while the others went on: the
/// positions and velocities of two joints or more do not belong together while one of the groups keeps every
/// digit, or velocities change while all torques keep every digit, which they did not do before. A robot at
/// rest, or at constant speed, contradicts nothing; a single joint's sensor may be faulty and is none of
/// this.
class StoppedColumns {
 public:
  /// The next row, which has this number from 0. Gives what is known of each group with it.
  const std::array<ColumnHold, kColumnGroups>& take(const Log& rows, int at, std::int64_t number);

 private:
  struct Follow {
    std::vector<double> last;   ///< values of the row before
    double since_s = 0.0;       ///< time of the hold's first row
    double usual_s = 0.0;       ///< longest short hold: of a source that is read more often than it measures
    std::int64_t changes = 0;   ///< rows that differ from the one before
    std::vector<double> apart;  ///< of each joint: change of the position less that of its velocity
    std::vector<double> low, high;  ///< of each joint's velocity
  };

  void begin(int group, const Log& rows, int at, std::int64_t number);
  void go_on(int group, const Log& rows, int at);
  bool is_contradicted(int group, int joints) const;
  bool is_long(int group, double time_s) const;

  std::array<ColumnHold, kColumnGroups> holds_;
  std::array<Follow, kColumnGroups> follow_;
  std::vector<double> q_, dq_;  ///< of the row before
  double t_ = 0.0;
};

/// A log in which what a recorder did not measure is missing: positions, velocities or torques of all joints
/// in which it stood still while the others went on (positions_stopped, velocities_stopped, torques_stopped).
class StoppedColumnsSource : public LogSource {
 public:
  explicit StoppedColumnsSource(std::unique_ptr<LogSource> source) : source_(std::move(source)) {}

  bool next(Log& segment) override;
  void rewind() override;
  const LogIdentity& identity() const override { return source_->identity(); }
  const Issues& issues() const override;
  double share_read() const override { return source_->share_read(); }

 private:
  void judge_rows();
  void empty_held(ColumnGroup group, const ColumnHold& hold, int up_to);
  int settled() const;

  std::unique_ptr<LogSource> source_;
  StoppedColumns columns_;
  std::array<ColumnHold, kColumnGroups> holds_;
  Log rows_;                     ///< not handed out yet; first_row as the source counts
  int judged_ = 0;               ///< of these
  std::int64_t handed_out_ = 0;  ///< rows before these
  bool at_end_ = false;
  Issues found_;
  mutable Issues issues_;
};

}  // namespace faultline
