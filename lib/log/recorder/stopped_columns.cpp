// SPDX-License-Identifier: MIT
#include "lib/log/recorder/stopped_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "lib/log/transformed/changed_source.hpp"

namespace faultline {
namespace {

constexpr double kShortestHold_s = 0.25;             // as for a recorder that stops as a whole
constexpr double kShortestTorque_s = 0.5;            // a coarse torque may stay the same for a while
constexpr int kFewestHeld = 4, kFewestTorques = 10;  // rows, decisive at slow rates
constexpr double kLongerThanBefore = 4.0;            // times the longest short hold before
constexpr double kApart = 0.01;                      // rad or m between position and integral of velocity
constexpr double kLeastDrift = 0.02;                 // the same per second: less is an offset of the velocity
constexpr double kChanging = 0.1;                    // rad/s or m/s: the torque must change for that
constexpr int kFewestJoints = 2;                     // the sensor of a single one may be faulty
constexpr std::int64_t kMostHeld = 4096;             // most rows that wait for a decision
constexpr std::int64_t kFewestTorqueChanges = 20;    // torques that never change are not judged

/// Groups of columns that a recorder reads together.
enum ColumnGroup { kPositions, kVelocities, kTorques, kColumnGroups };

/// Returns the columns of a group; `AnyLog` is Log or const Log.
template <typename AnyLog>
auto& group_of(AnyLog& rows, int group) {
  constexpr std::array<JointSignals Log::*, kColumnGroups> kMembers{&Log::q, &Log::dq, &Log::tau};
  return rows.*kMembers[static_cast<std::size_t>(group)];
}

void take_row(const JointSignals& signals, int at, std::vector<double>& values) {
  values.resize(signals.size());
  for (std::size_t j = 0; j < signals.size(); ++j) values[j] = signals[j][at];
}

bool is_row(const JointSignals& signals, int at, const std::vector<double>& values) {
  if (values.size() != signals.size()) return false;
  for (std::size_t j = 0; j < signals.size(); ++j)
    if (values[j] != signals[j][at]) return false;
  return true;
}

double shortest_hold_s(int group) { return group == kTorques ? kShortestTorque_s : kShortestHold_s; }

struct GroupWords {
  const char* code;
  const char* what;
};

GroupWords words_of(int group, bool is_zero) {
  if (group == kPositions)
    return {"positions_stopped",
            "the positions of all joints repeat every digit although their velocities show motion"};
  if (group == kVelocities)
    return {
        "velocities_stopped",
        is_zero
            ? "the velocities of all joints are zero although their positions change"
            : "the velocities of all joints repeat every digit although their positions move differently"};
  return {"torques_stopped",
          is_zero
              ? "the torques of all joints are zero although the joints accelerate and decelerate"
              : "the torques of all joints repeat every digit although the joints accelerate and decelerate"};
}

/// State of a group whose joints all keep every digit from one row to the next.
struct ColumnHold {
  std::int64_t first_row = 0;  ///< from 0: the row that the others repeat
  std::int64_t repeats = 0;    ///< rows after it
  bool is_zero = false;        ///< all of its values are exactly zero
  bool stopped = false;        ///< contradicted by the other columns: these rows were not measured
  bool decided = false;        ///< final until the hold ends
};

/// Finds groups of columns that the recorder did not update, or wrote as zeros.
class StoppedColumns {
 public:
  /// Takes the next row, with its number from 0.
  void take(const Log& rows, int at, std::int64_t number) {
    for (int group = 0; group < kColumnGroups; ++group) {
      ColumnHold& hold = holds_[group];
      const JointSignals& signals = group_of(rows, group);
      const bool has_velocity = !signals.empty() && !rows.dq.empty();
      if (!has_velocity || !is_row(signals, at, follow_[group].last)) {
        begin(group, rows, at, number);
        hold.decided = !has_velocity;
        continue;
      }
      ++hold.repeats;
      if (hold.decided) continue;
      go_on(group, rows, at);
      if (is_long(group, rows.time[at]) && is_contradicted(group, static_cast<int>(rows.q.size())))
        hold.stopped = hold.decided = true;
      else
        hold.decided = hold.repeats > kMostHeld;
    }
    take_row(rows.q, at, q_);
    take_row(rows.dq, at, dq_);
    t_ = rows.time[at];
  }
  /// The state of each group at that row.
  const std::array<ColumnHold, kColumnGroups>& holds() const { return holds_; }

 private:
  struct Follow {
    std::vector<double> last;       ///< values of the row before
    double since_s = 0.0;           ///< time of the first row of the hold
    double usual_s = 0.0;           ///< longest short hold, as of a source slower than the recorder
    std::int64_t changes = 0;       ///< rows that differ from the one before
    std::vector<double> apart;      ///< for each joint: change of position minus integral of velocity
    std::vector<double> low, high;  ///< least and largest velocity of each joint
  };

  void begin(int group, const Log& rows, int at, std::int64_t number) {
    Follow& of = follow_[group];
    ColumnHold& hold = holds_[group];
    if (t_ - of.since_s < shortest_hold_s(group)) of.usual_s = std::max(of.usual_s, t_ - of.since_s);
    take_row(group_of(rows, group), at, of.last);
    of.since_s = rows.time[at];
    ++of.changes;
    of.apart.assign(rows.q.size(), 0.0);
    of.low.assign(rows.dq.size(), std::numeric_limits<double>::infinity());
    of.high.assign(rows.dq.size(), -std::numeric_limits<double>::infinity());
    hold = {.first_row = number};
    hold.is_zero = std::all_of(of.last.begin(), of.last.end(), [](double value) { return value == 0.0; });
  }

  void go_on(int group, const Log& rows, int at) {
    Follow& of = follow_[group];
    const double step_s = rows.time[at] - t_;
    for (std::size_t j = 0; j < rows.dq.size(); ++j) {
      const double moved = rows.q[j][at] - q_[j], by_speed = 0.5 * (rows.dq[j][at] + dq_[j]) * step_s;
      if (std::isfinite(moved) && std::isfinite(by_speed)) of.apart[j] += moved - by_speed;
      of.low[j] = std::fmin(of.low[j], rows.dq[j][at]);
      of.high[j] = std::fmax(of.high[j], rows.dq[j][at]);
    }
  }

  bool is_contradicted(int group, int joints) const {
    const Follow& of = follow_[group];
    const bool is_torque = group == kTorques;
    const double least_apart = std::max(kApart, kLeastDrift * (t_ - of.since_s));
    int contradict = 0;
    for (int j = 0; j < joints; ++j)
      contradict += is_torque ? of.high[j] - of.low[j] > kChanging : std::abs(of.apart[j]) > least_apart;
    return contradict >= kFewestJoints && (!is_torque || of.changes >= kFewestTorqueChanges);
  }

  bool is_long(int group, double time_s) const {
    const bool is_torque = group == kTorques;
    const double least_s = std::max(shortest_hold_s(group), kLongerThanBefore * follow_[group].usual_s);
    return holds_[group].repeats >= (is_torque ? kFewestTorques : kFewestHeld) &&
           time_s - follow_[group].since_s >= least_s;
  }

  std::array<ColumnHold, kColumnGroups> holds_;
  std::array<Follow, kColumnGroups> follow_;
  std::vector<double> q_, dq_;  ///< of the row before
  double t_ = 0.0;
};

class EmptiedColumns {
 public:
  bool next(LogSource& source, Log& segment) {
    while (settled() == 0) {
      if (at_end_) return false;
      at_end_ = !source.next(segment);
      if (at_end_) continue;
      append(rows_, std::move(segment));
      judge_rows();
    }
    const int done = settled();
    segment = take_front(rows_, done);
    handed_out_ += done;
    judged_ -= done;
    return true;
  }

  const Issues& issues() const { return found_; }

 private:
  void judge_rows() {
    for (; judged_ < rows_.rows(); ++judged_) {
      columns_.take(rows_, judged_, handed_out_ + judged_);
      for (int group = 0; group < kColumnGroups; ++group)
        if (columns_.holds()[group].stopped) empty_held(group, columns_.holds()[group], judged_);
    }
  }

  /// Replaces the values of a hold by NaN; its first row was measured unless it is zero as well.
  void empty_held(int group, const ColumnHold& hold, int up_to) {
    JointSignals& signals = group_of(rows_, group);
    const std::int64_t first = hold.first_row + (hold.is_zero ? 0 : 1) - handed_out_;
    const GroupWords words = words_of(group, hold.is_zero);
    for (int row = static_cast<int>(std::max<std::int64_t>(first, 0)); row <= up_to; ++row) {
      if (std::isnan(signals.front()[row])) continue;
      const std::int64_t number = rows_.first_row + row + 1;
      found_.add(
          {words.code, "", Severity::warning,
           fmt::format("row {}: {}: the recorder did not measure them; such values are treated as missing",
                       number, words.what),
           number, rows_.time[row], 1});
      for (std::vector<double>& joint : signals) joint[row] = std::nan("");
    }
  }

  /// Returns the number of rows that no later row can change.
  int settled() const {
    if (at_end_) return rows_.rows();
    std::int64_t least = judged_;
    for (const ColumnHold& hold : columns_.holds())
      if (!hold.decided && hold.repeats > 0) least = std::min(least, hold.first_row - handed_out_);
    return static_cast<int>(std::max<std::int64_t>(least, 0));
  }

  StoppedColumns columns_;
  Log rows_;                     ///< rows not handed out yet; first_row as in the source
  int judged_ = 0;               ///< number of these that were judged
  std::int64_t handed_out_ = 0;  ///< rows before these
  bool at_end_ = false;
  Issues found_;
};

}  // namespace

std::unique_ptr<LogSource> without_stopped_columns(std::unique_ptr<LogSource> source) {
  return std::make_unique<StagedSource<EmptiedColumns>>(std::move(source));
}

}  // namespace faultline
