// SPDX-License-Identifier: MIT
#include "lib/log/quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/log/channel_names.hpp"
#include "lib/log/issues/velocity_issues.hpp"
#include "lib/log/log_channels.hpp"

namespace faultline {
namespace {

void add_value(ChannelSummary& channel, double value) {
  ++channel.values;
  if (value < channel.min) channel.min = value, channel.at_min = 0;
  if (value > channel.max) channel.max = value, channel.at_max = 0;
  channel.at_min += value == channel.min;
  channel.at_max += value == channel.max;
  if (!std::isnan(channel.last)) channel.path += std::abs(value - channel.last);
  channel.last = value;
}

void add_values(ChannelSummary& channel, const std::vector<double>& values, const Log& segment) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(values[i])) {
      add_value(channel, values[i]);
    } else if (channel.missing++ == 0) {
      channel.first_missing_row = segment.first_row + static_cast<std::int64_t>(i) + 1;
      channel.first_missing_s = segment.time[i];
    }
  }
}

/// Fewer values than this are not judged constant or saturated.
constexpr std::int64_t kFewestValues = 20;
constexpr double kSlideSpan = 10.0;       // m; a position that spans more is hardly in m
constexpr double kFastestMotion = 50.0;   // a velocity beyond it is hardly in rad/s
constexpr double kLongestPeriod_s = 0.9;  // a longer sample period is hardly in seconds
constexpr double kSaturatedShare = 0.01;  // least share of torque values at the largest or smallest
constexpr double kFarAway = 5.0;          // times the largest span: no joint is that far from zero
constexpr double kOneWay = 1.2;           // path to span of a joint that turns one way, with some noise
constexpr double kFastTurning = 20.0;     // rad/s on average; joints of arms turn slower

bool starts_with(const std::string& name, const char* prefix) { return name.rfind(prefix, 0) == 0; }

bool is_measurement(const ChannelSummary& channel) {
  const auto known = canonical_channel(channel.name);
  return channel.canonical && known && known->quantity != Quantity::q_ref &&
         known->quantity != Quantity::dq_ref && known->quantity != Quantity::tau_ref;
}

double share(std::int64_t part, std::int64_t all) {
  return all > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(all) : 0.0;
}

void judge_missing(const ChannelSummary& channel, Issues& issues) {
  if (channel.missing == 0) return;
  const bool all = channel.values == 0;
  const Severity severity = !channel.canonical ? Severity::note : all ? Severity::severe : Severity::warning;
  issues.add(
      {"missing_values", channel.name, severity,
       all ? "has no values"
           : fmt::format("{:.2g} % of the values are missing, first at {:.10g} s; they stay missing",
                         share(channel.missing, channel.values + channel.missing), channel.first_missing_s),
       channel.first_missing_row, channel.first_missing_s, channel.missing});
}

void judge_constant(const ChannelSummary& channel, Issues& issues) {
  if (!is_measurement(channel) || !channel.constant() || channel.values < kFewestValues) return;
  issues.add({"constant_channel", channel.name, Severity::warning,
              fmt::format("is {:.6g} in every row: the joint is at rest, or the channel was not connected",
                          channel.min)});
}

void judge_saturated(const ChannelSummary& channel, Issues& issues) {
  if (!channel.canonical || !starts_with(channel.name, "tau") || channel.constant()) return;
  for (const auto& [limit, times] : {std::pair{channel.min, channel.at_min}, {channel.max, channel.at_max}}) {
    if (limit == 0.0 || times < kFewestValues || share(times, channel.values) < 100.0 * kSaturatedShare)
      continue;
    issues.add({"saturated_channel", channel.name, Severity::warning,
                fmt::format("is at its limit of {:.6g} in {:.2g} % of the rows", limit,
                            share(times, channel.values)),
                0, std::nan(""), times});
  }
}

enum class Axis { unknown, turns, slides };

Axis axis_of(const ChannelSummary& channel, const QualityOptions& options) {
  const auto known = canonical_channel(channel.name);
  const std::size_t joint = known ? static_cast<std::size_t>(known->joint) : 0;
  if (joint == 0 || joint > options.slides.size()) return Axis::unknown;
  return options.slides[joint - 1] ? Axis::slides : Axis::turns;
}

/// The unit that a channel is taken in, the units that are more likely, and the unit to name as an example.
struct UnitWords {
  const char* si;
  const char* likely;
  const char* unit;
};

UnitWords position_words(Axis axis) {
  if (axis == Axis::slides) return {"m", "mm", "mm"};
  if (axis == Axis::turns) return {"rad", "deg", "deg"};
  return {"rad or m", "deg (a turning axis) or mm (a sliding one)", "deg"};
}

UnitWords velocity_words(Axis axis) {
  if (axis == Axis::slides) return {"m/s", "mm/s", "mm/s"};
  if (axis == Axis::turns) return {"rad/s", "deg/s or rpm", "deg/s"};
  return {"rad/s or m/s", "deg/s or rpm (a turning axis) or mm/s (a sliding one)", "deg/s"};
}

/// Whether a joint moves one way all the time, at a speed that a joint in rad can have.
bool turns_on_and_on(const ChannelSummary& channel, const TimeAxis& time) {
  const double lasts = time.end_s - time.start_s;
  return channel.path <= kOneWay * (channel.max - channel.min) && channel.path <= kFastTurning * lasts;
}

void judge_span(const ChannelSummary& channel, const TimeAxis& time, const QualityOptions& options,
                Issues& issues) {
  if (!channel.canonical || !starts_with(channel.name, "q") || channel.values == 0) return;
  const Axis axis = axis_of(channel, options);
  const double most = axis == Axis::slides ? kSlideSpan : options.position_span;
  const double largest = std::max(std::abs(channel.min), std::abs(channel.max));
  if (channel.max - channel.min < most && largest < kFarAway * most) return;
  const UnitWords words = position_words(axis);
  const bool turns_on = axis != Axis::slides && turns_on_and_on(channel, time);
  const std::string what =
      turns_on
          ? fmt::format(
                "moves in one direction from {:.6g} to {:.6g}: a joint that turns without end, or not in {}",
                channel.min, channel.max, words.si)
          : fmt::format("is between {:.6g} and {:.6g}, which is hardly in {}", channel.min, channel.max,
                        words.si);
  issues.add({"unit_implausible", channel.name, turns_on ? Severity::warning : Severity::severe,
              fmt::format("{}; if it is {}, state the unit in the header, \"{} [{}]\", or in the robot file: "
                          "[log.columns] {} = {{unit = \"{}\"}}",
                          what, words.likely, channel.name, words.unit, channel.name, words.unit)});
}

void judge_speed(const ChannelSummary& channel, const QualityOptions& options, Issues& issues) {
  if (!channel.canonical || !starts_with(channel.name, "dq") || channel.values == 0) return;
  if (std::max(std::abs(channel.min), std::abs(channel.max)) < kFastestMotion) return;
  const UnitWords words = velocity_words(axis_of(channel, options));
  issues.add({"unit_implausible", channel.name, Severity::warning,
              fmt::format("is between {:.6g} and {:.6g}, which is hardly in {}; if it is {}, state the unit "
                          "in the header or in the robot file: [log.columns] {} = {{unit = \"{}\"}}",
                          channel.min, channel.max, words.si, words.likely, channel.name, words.unit)});
}

void judge_time(const TimeAxis& time, Issues& issues) {
  if (time.period_s > kLongestPeriod_s)
    issues.add(
        {"unit_implausible", "t", Severity::severe,
         fmt::format(
             "the time steps by {:.6g}, which is hardly in seconds; if it is ms, us or ns, state the unit in "
             "the header, \"t [ms]\", or in the robot file: [log.columns] t = {{unit = \"ms\"}}",
             time.period_s)});
  const TimeGap first = time.listed_gaps.empty() ? TimeGap{} : time.listed_gaps.front();
  if (time.gaps > 0)
    issues.add(
        {"time_gap", "t", Severity::warning,
         fmt::format(
             "rows are missing after {:.10g} s; gaps last {:.4g} s together, the longest {:.4g} s; nothing "
             "was filled in",
             first.start_s, time.in_gaps_s, time.longest_gap_s),
         first.row, first.start_s, time.gaps});
  if (time.uneven_steps > time.rows / 100)
    issues.add(
        {"time_jitter", "t", Severity::warning,
         fmt::format(
             "{:.1f} % of the steps are uneven (rms {:.3g} s about {:.6g} s); the recorded times were used",
             share(time.uneven_steps, time.rows - 1), time.jitter_s, time.period_s),
         0, time.start_s, time.uneven_steps});
}

void judge_channel(const ChannelSummary& channel, const TimeAxis& time, const QualityOptions& options,
                   Issues& issues) {
  judge_missing(channel, issues);
  judge_constant(channel, issues);
  judge_saturated(channel, issues);
  judge_span(channel, time, options, issues);
  judge_speed(channel, options, issues);
}

}  // namespace

void assess(const Log& segment, QualityState& state) {
  state.time.add(segment.time);
  std::size_t at = 0;
  const auto add = [&](const std::string& name, const std::string& unit, bool canonical, const auto& values) {
    if (at == state.channels.size())
      state.channels.push_back({.name = name, .unit = unit, .canonical = canonical});
    add_values(state.channels[at++], values, segment);
  };
  for_each_joint_channel(segment, [&](const std::vector<double>& values, Channel channel) {
    add(to_string(channel), "", true, values);
  });
  for (const ExtraChannel& extra : segment.extra) add(extra.name, extra.unit, false, extra.values);
  state.velocity.resize(segment.dq.size());
  for (std::size_t j = 0; j < segment.dq.size(); ++j)
    state.velocity[j].add(segment.time, segment.q[j], segment.dq[j]);
}

LogQuality quality_of(const QualityState& state, const QualityOptions& options) {
  LogQuality quality;
  quality.time = without_run_breaks(state.time.result(), options.runs);
  quality.channels = state.channels;
  judge_time(quality.time, quality.issues);
  for (const ChannelSummary& channel : state.channels)
    judge_channel(channel, quality.time, options, quality.issues);
  for (const VelocityCheck& velocity : state.velocity) quality.velocity.push_back(velocity.result());
  judge_velocities(quality.velocity, quality.time, options, quality.issues);
  judge_motion_scale(quality.velocity, quality.issues);
  return quality;
}

}  // namespace faultline
