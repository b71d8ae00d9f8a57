// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/log.hpp"
#include "lib/log/quality.hpp"
#include "lib/plausibility/checkup/channel_course.hpp"
#include "lib/plausibility/checkup/joint_relations.hpp"

namespace faultline {

/// Count of rows whose joint channels all equal those of the row before, at another time: the logger is
/// faster than its source.
struct RepeatedRowCount {
  std::int64_t rows = 0;       ///< all, also those of a robot at rest
  std::int64_t held = 0;       ///< in short stretches, directly after which joints moved
  std::int64_t longest = 0;    ///< in one stretch
  std::int64_t first_row = 0;  ///< of the first short stretch, from 1; 0 for none
};

/// For all joint channels together, and for the positions alone.
struct RepeatedRowCounts {
  RepeatedRowCount all, positions;
  /// Rows in which some positions change and others do not, as with coarse encoders.
  std::int64_t mixed = 0;
};

class RepeatedRowCheck {
 public:
  void add(const Log& segment);
  RepeatedRowCounts result() const;

 private:
  /// Stretches of successive rows with the same values.
  struct Runs {
    void take(bool repeats);
    void end();

    std::int64_t row = 0, run = 0;
    RepeatedRowCount found{};
  };
  std::vector<double> last_, now_;
  Runs all_, positions_;
  std::int64_t mixed_ = 0;
};

/// A lasting change of the sample period of a log.
struct PeriodChange {
  double at_s = 0.0;
  std::int64_t row = 0;  ///< about; the row before the first step of the new period, from 1
  double before_s = 0.0, after_s = 0.0;
};

/// Detects lasting changes of the sample period: over many steps, not by gaps or jitter.
class ClockCheck {
 public:
  void add(double t);
  /// Returns the first hundred changes.
  const std::vector<PeriodChange>& changes() const { return changes_; }

 private:
  /// Successive steps.
  struct Block {
    double start_s = 0.0;
    std::int64_t row = 0;
    double period_s = 0.0;  ///< mean of the steps without the shortest and longest
  };
  void close_block();

  std::int64_t rows_ = 0;
  double last_s_ = 0.0;
  std::vector<double> steps_;
  Block block_;
  double usual_s_ = 0.0;      ///< period so far, 0 if unknown
  std::vector<Block> other_;  ///< successive blocks with another period
  std::vector<PeriodChange> changes_;
};

struct ChannelCheckup {
  Channel channel;
  ChannelCourse::Result course;
};

struct JointCheckup {
  VelocityRelated velocity;
  TorqueRelated torque;
};

/// Result of the checkup of the canonical channels of a log, beside its LogQuality.
struct CheckupResult {
  std::vector<ChannelCheckup> channels;
  std::vector<JointCheckup> joints;
  std::vector<PeriodChange> clock_changes;
  RepeatedRowCounts repeated;

  /// Returns null if the log has no such channel.
  const ChannelCheckup* find(Channel channel) const;
};

/// Checks a log segment by segment; the result does not depend on the segments.
class Checkup {
 public:
  void add(const Log& segment);
  CheckupResult result() const;

 private:
  void settle();
  void take(const Log& segment);
  void take_joint(const Log& segment, std::size_t joint);

  Log head_;  ///< first rows, until the sample period is known
  bool settled_ = false;
  ClockCheck clock_;
  RepeatedRowCheck repeated_;
  std::vector<Channel> channels_;
  std::vector<ChannelCourse> courses_;
  std::vector<VelocityRelation> velocity_;
  std::optional<TorqueRelation> torque_;
  /// For each joint: the integral of its velocity, with the time and velocity that it has reached.
  struct Path {
    double place = 0.0, t = 0.0, dq = 0.0;
    bool begun = false;
  };
  std::vector<Path> paths_;
  std::vector<std::vector<double>> places_;  ///< of each joint in the segment, by its velocity
};

/// Returns the issues clock_change, rows_repeated, positions_repeated, velocity_off, stuck_channel,
/// torque_against_acceleration, torque_delayed, velocity_late and unit_implausible.
Issues checkup_issues(const CheckupResult& checkup, const LogQuality& quality);

/// Returns the largest share, 0 to 1, of a channel's values at its least or largest value.
double share_at_limits(const ChannelSummary& summary);

/// Returns the share, 0 to 1, of the rows of the time span that are present; NaN if the period is unknown.
double completeness(const TimeAxis& time);

}  // namespace faultline
