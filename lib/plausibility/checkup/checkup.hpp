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
#include "lib/plausibility/checkup/clock_check.hpp"
#include "lib/plausibility/checkup/repeated_rows.hpp"
#include "lib/plausibility/checkup/torque_relation.hpp"
#include "lib/plausibility/checkup/velocity_relation.hpp"

namespace faultline {

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
