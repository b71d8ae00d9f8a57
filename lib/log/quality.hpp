// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/log/log.hpp"
#include "lib/log/time_axis.hpp"
#include "lib/log/velocity_check.hpp"

namespace faultline {

/// Code of the issue that positions, velocities and time of most joints differ by one common factor.
inline constexpr const char* kScaledMotion = "motion_scaled";

/// Range of a position, rad, that healthy joints of arms do not exceed: just above two turns.
inline constexpr double kHealthySpan_rad = 13.0;
/// A longer sample period is hardly in seconds.
inline constexpr double kLongestPeriod_s = 0.9;

/// Summary of one channel over the whole log.
struct ChannelSummary {
  std::string name{};  ///< canonical, or the name of the column for an extra channel
  std::string unit{};  ///< unit of an extra channel; canonical ones are SI
  bool canonical = true;
  double min = std::numeric_limits<double>::infinity();  ///< infinity, above max, if there is no value
  double max = -std::numeric_limits<double>::infinity();
  std::int64_t values = 0;
  std::int64_t missing = 0;
  std::int64_t first_missing_row = 0;  ///< from 1; 0 for none
  double first_missing_s = std::numeric_limits<double>::quiet_NaN();
  std::int64_t at_min = 0;  ///< values equal to min
  std::int64_t at_max = 0;
  double path = 0.0;  ///< sum of the absolute steps from value to value
  double last = std::numeric_limits<double>::quiet_NaN();

  void add(double value);  ///< not NaN
  bool constant() const { return values > 1 && min == max; }
};

struct QualityOptions {
  /// A position that spans more, or lies beyond 5 times this, is hardly in rad; the limit leaves room for a
  /// joint that turns a few times after a fault has released it.
  double position_span = 20.0;
  std::vector<std::string> stated_units{};  ///< LogIdentity::stated_units: a long way in these is a warning
  std::vector<bool> slides{};               ///< whether each joint slides (its unit is m); empty if unknown
  std::vector<LogRun> runs{};  ///< runs of the log's clock: the step between two of them is no gap
};

/// Result of the quality pass over all rows; complete after the last segment.
struct LogQuality {
  TimeAxis time;
  std::vector<ChannelSummary> channels;     ///< without t; canonical ones first
  std::vector<VelocityAgreement> velocity;  ///< for each joint; empty without velocities
  Issues issues;  ///< time_gap, time_jitter, missing_values, constant_channel, saturated_channel,
                  ///< velocity_contradicts_position, sample_period_contradicts_motion, motion_scaled,
                  ///< unit_implausible
};

/// State of the quality pass between segments.
struct QualityState {
  TimeAxisPass time;
  std::vector<ChannelSummary> channels;
  std::vector<VelocityCheck> velocity;
};

/// Returns the likely cause of a position that changes `factor` times as fast as its velocity, as a clause
/// such as "the velocity seems to be in deg/s, the position in rad". A joint of unknown kind neither turns
/// nor slides.
std::string velocity_guess(double factor, bool turns, bool slides);

void assess(const Log& segment, QualityState& state);
LogQuality quality_of(const QualityState& state, const QualityOptions& options = {});

}  // namespace faultline
