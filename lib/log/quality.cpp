// SPDX-License-Identifier: MIT
#include "lib/log/quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "lib/core/statistics.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/log.hpp"

namespace faultline {
namespace {

void add_values(ChannelSummary& channel, const std::vector<double>& values, const Log& segment) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(values[i])) {
      channel.add(values[i]);
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
  const Joint joint = known ? known->joint : Joint();
  if (joint.is_none() || joint.index() >= std::ssize(options.slides)) return Axis::unknown;
  return options.slides[joint.index()] ? Axis::slides : Axis::turns;
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

/// Whether the unit of a position, or of the position that a reference is for, is stated.
bool has_stated_unit(const std::string& name, const QualityOptions& options) {
  std::vector<std::string> names = {name};
  if (const auto channel = canonical_channel(name)) names.push_back(to_string({Quantity::q, channel->joint}));
  return std::ranges::any_of(names, [&](const std::string& each) {
    return std::ranges::find(options.stated_units, each) != options.stated_units.end();
  });
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
  const bool is_stated = has_stated_unit(channel.name, options);
  const std::string what =
      turns_on
          ? fmt::format(
                "moves in one direction from {:.6g} to {:.6g}: a joint that turns without end, or not in {}",
                channel.min, channel.max, words.si)
          : fmt::format("is between {:.6g} and {:.6g}, which is hardly in {}", channel.min, channel.max,
                        words.si);
  if (is_stated) {
    issues.add(
        {"unit_implausible", channel.name, Severity::warning, what + ", the unit that is stated for it"});
    return;
  }
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

constexpr double kDegrees = 57.2958;
constexpr double kRpm = 0.104720;
constexpr double kNear = 0.1;        // relative, of a factor from the one that a unit gives
constexpr double kSameFactor = 0.1;  // relative spread of the joints' factors if they have one common cause

bool near(double factor, double value) { return std::abs(factor / value - 1.0) < kNear; }

/// Returns the factor between positions and the integrals of velocities that all moving joints, at least two,
/// share; 1 if they share none, or if a joint agrees or contradicts.
double common_factor(const std::vector<VelocityAgreement>& agreements) {
  std::vector<double> factors;
  for (const VelocityAgreement& agreement : agreements) {
    if (agreement.verdict == VelocityVerdict::contradicts || agreement.verdict == VelocityVerdict::agrees)
      return 1.0;
    if (agreement.verdict == VelocityVerdict::scaled) factors.push_back(agreement.factor);
  }
  if (factors.size() < 2) return 1.0;
  std::sort(factors.begin(), factors.end());
  const double middle = factors[factors.size() / 2];
  if (factors.front() <= 0.0 || factors.back() > (1.0 + kSameFactor) * middle ||
      factors.front() < (1.0 - kSameFactor) * middle)
    return 1.0;
  return middle;
}

/// Whether units of angles explain a factor that all joints share, which requires that none of them slides.
bool is_of_angles(double factor, const QualityOptions& options) {
  const bool some_slide = std::count(options.slides.begin(), options.slides.end(), true) > 0;
  return !some_slide && (near(factor, kDegrees) || near(factor, 1.0 / kDegrees) || near(factor, kRpm));
}

std::string time_guess(double factor, double period_s) {
  for (const auto& [unit, si] : {std::pair{"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}})
    if (near(factor, si)) return fmt::format("the time seems to be in {}, but was treated as s", unit);
  for (const auto& [unit, si] : {std::pair{"ms", 1e3}, {"us", 1e6}, {"ns", 1e9}})
    if (near(factor, si)) return fmt::format("the time seems to be in s, but was treated as {}", unit);
  return fmt::format(
      "the sample period seems to be {:.4g} s, not {:.4g} s: multiply the scale of t by {:.4g}",
      factor * period_s, period_s, factor);
}

void judge_one(const VelocityAgreement& agreement, Joint joint, const std::string& why, Issues& issues) {
  const std::string channel = to_string({Quantity::dq, joint});
  if (agreement.verdict == VelocityVerdict::scaled)
    issues.add({"velocity_contradicts_position", channel, Severity::severe,
                fmt::format("the position changes {:.4g} times as fast as the velocity: {}", agreement.factor,
                            why)});
  if (agreement.verdict == VelocityVerdict::contradicts)
    issues.add({"velocity_contradicts_position", channel, Severity::warning,
                fmt::format("the velocity does not follow the position (correlation {:.2f}); one of them "
                            "belongs to another joint, or was stuck",
                            agreement.correlation)});
}

constexpr double kLeastOff = 0.004;      // difference of the factor from 1; healthy logs have less
constexpr double kSurelyOff = 5.0;       // the same in standard deviations
constexpr double kOneScale = 0.002;      // between factors of two joints; errors of integrals are smaller
constexpr double kScaleDoubts = 3.0;     // the same in standard deviations
constexpr double kShareAlike = 2.0 / 3;  // of the moving joints: the sensor of one may drift

void judge_velocities(const std::vector<VelocityAgreement>& agreements, const TimeAxis& time,
                      const QualityOptions& options, Issues& issues) {
  const double factor = common_factor(agreements);
  const bool all_alike = factor != 1.0 && !is_of_angles(factor, options);
  if (all_alike)
    issues.add({"sample_period_contradicts_motion", "t", Severity::severe,
                fmt::format("the positions of all moving joints change {:.4g} times as fast as their "
                            "velocities: {}; correct it in the robot file: [log.columns] t",
                            factor, time_guess(factor, time.period_s))});
  for (std::size_t j = 0; j < agreements.size(); ++j) {
    const bool known = j < options.slides.size();
    const Joint joint = Joint::at(static_cast<int>(j));
    const std::string guess =
        velocity_guess(agreements[j].factor, known && !options.slides[j], known && options.slides[j]);
    const std::string why = all_alike ? "so do those of all moving joints, see the sample period"
                                      : guess + "; correct it in the robot file: [log.columns] " +
                                            to_string({Quantity::dq, joint});
    judge_one(agreements[j], joint, why, issues);
  }
}

void judge_motion_scale(const std::vector<VelocityAgreement>& agreements, Issues& issues) {
  std::vector<VelocityAgreement> moving;
  std::vector<double> factors;
  for (const VelocityAgreement& joint : agreements)
    if (joint.verdict == VelocityVerdict::agrees && joint.is_one_motion()) {
      moving.push_back(joint);
      factors.push_back(joint.factor);
    }
  if (moving.size() < 2) return;
  const double factor = upper_median(factors);
  double least_std = std::numeric_limits<double>::infinity();
  int alike = 0;
  for (const VelocityAgreement& joint : moving) {
    if (std::abs(joint.factor - factor) > std::max(kScaleDoubts * joint.factor_std, kOneScale)) continue;
    least_std = std::min(least_std, joint.factor_std);
    ++alike;
  }
  const auto enough = std::max(2.0, kShareAlike * static_cast<double>(moving.size()));
  if (alike < enough || std::abs(factor - 1.0) < std::max(kLeastOff, kSurelyOff * least_std)) return;
  issues.add(make_issue(kScaledMotion, Severity::warning,
                        fmt::format("the positions of {} of {} moving joints change {:.4f} times as fast as "
                                    "their velocities: the clock or the positions are scaled. If the clock "
                                    "is scaled, correct it in the robot file, [log.columns] t = {{scale = "
                                    "{:.4f}}}; if the positions are, use {{scale = {:.4f}}} for each of them",
                                    alike, moving.size(), factor, factor, 1.0 / factor)));
}

}  // namespace

void ChannelSummary::add(double value) {
  ++values;
  if (value < min) min = value, at_min = 0;
  if (value > max) max = value, at_max = 0;
  at_min += value == min;
  at_max += value == max;
  if (!std::isnan(last)) path += std::abs(value - last);
  last = value;
}

std::string velocity_guess(double factor, bool turns, bool slides) {
  if (factor < 0.0) return "the sign of one of them is wrong";
  if (!slides && near(factor, kDegrees)) return "the position seems to be in degrees, the velocity in rad/s";
  if (!slides && near(factor, 1.0 / kDegrees))
    return "the velocity seems to be in deg/s, the position in rad";
  if (!slides && near(factor, kRpm)) return "the velocity seems to be in rpm, the position in rad";
  if (near(factor, 1e3))
    return turns ? "the velocity's unit is 1000 times too large, or the time is in s and was treated as ms"
                 : "the position seems to be in mm, the velocity in m/s, or the time in s and treated as ms";
  if (near(factor, 1e-3))
    return turns ? "the time seems to be in ms"
                 : "the time seems to be in ms, or the velocity in mm/s and the position in m";
  return "their units, a gear ratio or the sample period differ";
}

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
