// SPDX-License-Identifier: MIT
#include "lib/log/columns/counted_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lib/core/statistics.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/time_axis.hpp"
#include "lib/log/units.hpp"

namespace faultline {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
/// Lowest, highest and typical rate, Hz, at which joints are logged.
constexpr double kSlowest = 2.0, kFastest = 2e4, kUsual = 200.0;
/// Hz; whole seconds from this rate on are accepted if nothing indicates another unit.
constexpr double kSlowestOfSeconds = 0.1;
constexpr std::size_t kLeastRows = 10;
/// Largest ratio to the unit that the motion indicates: a factor between two units is 1000.
constexpr double kSameUnit = 10.0;
constexpr std::array kCounts{"", "ms", "us", "ns"};  ///< each 1000 times finer than the one before

double rate_of(double step, const char* unit) { return 1.0 / (step * *si_factor(unit)); }

bool is_usual(double rate) { return rate >= kSlowest && rate <= kFastest; }

bool counts_whole_numbers(const std::vector<double>& time) {
  return std::all_of(time.begin(), time.end(), [](double t) { return t == std::floor(t); });
}

/// Estimates the seconds per count from a joint's position and velocity; NaN if it does not move.
double seconds_by(const std::vector<double>& time, const std::vector<double>& q,
                  const std::vector<double>& dq) {
  double moved = 0.0, integrated = 0.0;
  for (std::size_t i = 1; i < std::min({time.size(), q.size(), dq.size()}); ++i) {
    const double path = 0.5 * (dq[i] + dq[i - 1]) * (time[i] - time[i - 1]);
    if (std::isnan(path) || std::isnan(q[i] - q[i - 1])) continue;
    moved += path * (q[i] - q[i - 1]);
    integrated += path * path;
  }
  return integrated > 0.0 && moved > 0.0 ? moved / integrated : kUnknown;
}

/// Returns the median of the estimates of the joints; NaN if no joint has one.
double seconds_by_motion(const std::vector<double>& time, const std::vector<NamedValues>& columns) {
  std::vector<double> estimates;
  for (const NamedValues& q : columns) {
    const ParsedName position = parse_name(q.name);
    if (position.quantity != Quantity::q) continue;
    for (const NamedValues& dq : columns) {
      const ParsedName velocity = parse_name(dq.name);
      if (velocity.quantity != Quantity::dq || velocity.number != position.number) continue;
      const double seconds = seconds_by(time, q.values, dq.values);
      if (!std::isnan(seconds)) estimates.push_back(seconds);
    }
  }
  return upper_median_of(estimates);
}

bool is_known_unit(const char* unit, double seconds) {
  const double ratio = seconds / *si_factor(unit);
  return ratio < kSameUnit && ratio > 1.0 / kSameUnit;
}

CountedTime by_motion(double step, double seconds) {
  for (const char* unit : kCounts)
    if (is_known_unit(unit, seconds) && *unit != '\0')
      return {unit, fmt::format("the time has no unit; it was treated as {}, with which the positions agree "
                                "with the velocities ({:.4g} Hz)",
                                unit, rate_of(step, unit))};
  return {};
}

CountedTime by_rate(double step, std::size_t first) {
  const char* best = "";
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = first; i < kCounts.size(); ++i) {
    const double rate = rate_of(step, kCounts[i]);
    const double far = std::max(rate, kUsual) / std::min(rate, kUsual);
    if (is_usual(rate) && far < nearest) best = kCounts[i], nearest = far;
  }
  if (*best == '\0') return {};
  return {best, fmt::format(
                    "the time has no unit; it was treated as {}, which gives {:.4g} Hz for steps of {:.4g}. "
                    "If that is wrong, state the unit in the robot file: [log.columns] t = {{unit = \"ms\"}}",
                    best, rate_of(step, best), step)};
}

}  // namespace

CountedTime counted_time(const std::vector<double>& time, const std::vector<NamedValues>& columns) {
  if (time.empty() || !counts_whole_numbers(time)) return {};
  const double step = median_step(time);
  const std::string since_1970 = epoch_unit(time.front());
  const auto epoch = std::find(kCounts.begin(), kCounts.end(), since_1970);
  const bool slow = step > 0.0 && !is_usual(rate_of(step, since_1970.c_str()));
  if (!since_1970.empty() && !slow) return {*epoch, ""};
  if (!(step > 1.0) || time.size() < kLeastRows) return {*epoch, ""};
  const double seconds = seconds_by_motion(time, columns);
  if (!std::isnan(seconds)) return by_motion(step, seconds);
  if (since_1970.empty() && rate_of(step, "") >= kSlowestOfSeconds) return {};
  const CountedTime by_usual_rate = by_rate(step, static_cast<std::size_t>(epoch - kCounts.begin()) + 1);
  return *by_usual_rate.unit == '\0' && !since_1970.empty() ? CountedTime{*epoch, ""} : by_usual_rate;
}

}  // namespace faultline
