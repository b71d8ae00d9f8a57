// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "lib/log/log.hpp"
#include "lib/log/transformed/changed_source.hpp"

namespace faultline {

/// Groups of columns that a recorder reads together.
enum class ColumnGroup { positions, velocities, torques };
inline constexpr int kColumnGroups = 3;

/// State of a group whose joints all keep every digit from one row to the next.
struct ColumnHold {
  std::int64_t first_row = 0;  ///< from 0: the row that the others repeat
  std::int64_t repeats = 0;    ///< rows after it
  bool is_zero = false;        ///< all of its values are exactly zero
  bool stopped = false;        ///< contradicted by the other columns: these rows were not measured
  bool decided = false;        ///< final until the hold ends
};

/// Finds groups of columns that the recorder did not update, or wrote as zeros, while the others went on: the
/// positions and velocities of at least two joints contradict each other while one of the groups keeps every
/// digit, or velocities change while all torques keep every digit after having changed before. A robot at
/// rest, or at constant speed, is no contradiction; a single joint is not judged, as its sensor may be
/// faulty.
class StoppedColumns {
 public:
  /// Takes the next row, with its number from 0. Returns the state of each group at this row.
  const std::array<ColumnHold, kColumnGroups>& take(const Log& rows, int at, std::int64_t number);

 private:
  struct Follow {
    std::vector<double> last;       ///< values of the row before
    double since_s = 0.0;           ///< time of the first row of the hold
    double usual_s = 0.0;           ///< longest short hold, as of a source slower than the recorder
    std::int64_t changes = 0;       ///< rows that differ from the one before
    std::vector<double> apart;      ///< for each joint: change of position minus integral of velocity
    std::vector<double> low, high;  ///< least and largest velocity of each joint
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

/// A log without values that a recorder did not measure: positions, velocities or torques of all joints
/// become NaN if they stopped while the others went on (positions_stopped, velocities_stopped,
/// torques_stopped).
class StoppedColumnsSource : public ChangedSource {
 public:
  explicit StoppedColumnsSource(std::unique_ptr<LogSource> source) : ChangedSource(std::move(source)) {}

  bool next(Log& segment) override;
  void rewind() override;
  const Issues& issues() const override;

 private:
  void judge_rows();
  void empty_held(ColumnGroup group, const ColumnHold& hold, int up_to);
  int settled() const;

  StoppedColumns columns_;
  std::array<ColumnHold, kColumnGroups> holds_;
  Log rows_;                     ///< rows not handed out yet; first_row as in the source
  int judged_ = 0;               ///< number of these that were judged
  std::int64_t handed_out_ = 0;  ///< rows before these
  bool at_end_ = false;
  Issues found_;
  mutable Issues issues_;
};

}  // namespace faultline
