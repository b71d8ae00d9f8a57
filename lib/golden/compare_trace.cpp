// SPDX-License-Identifier: MIT
#include "lib/golden/compare_trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lib/core/number_text.hpp"

namespace faultline {
namespace {

/// Indices of points of equal time, in order of time.
std::vector<std::pair<int, int>> common_points(const Trace& a, const Trace& b) {
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0, j = 0; i < a.points() && j < b.points();) {
    const double near = 1e-9 * std::max(1.0, std::abs(a.time[i]));
    if (std::abs(a.time[i] - b.time[j]) <= near)
      pairs.emplace_back(i++, j++);
    else
      ++(a.time[i] < b.time[j] ? i : j);
  }
  return pairs;
}

struct ChannelCheck {
  int first = -1;  ///< of the common points
  int count = 0;
};

ChannelCheck check(const std::vector<double>& expected, const std::vector<double>& actual,
                   const std::vector<std::pair<int, int>>& points, const Tolerance& tolerance) {
  ChannelCheck found;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (tolerance.agree(expected[points[k].first], actual[points[k].second])) continue;
    if (found.count++ == 0) found.first = static_cast<int>(k);
  }
  return found;
}

/// The first point, by time, that only one trace has.
struct LonePoint {
  double time_s = std::numeric_limits<double>::infinity();
  bool is_expected = false;
};

LonePoint first_lone_point(const Trace& expected, const Trace& actual,
                           const std::vector<std::pair<int, int>>& points) {
  std::size_t k = 0;
  while (k < points.size() && points[k] == std::pair(static_cast<int>(k), static_cast<int>(k))) ++k;
  LonePoint lone;
  if (k < expected.time.size()) lone = {expected.time[k], true};
  if (k < actual.time.size() && actual.time[k] < lone.time_s) lone = {actual.time[k], false};
  return lone;
}

void compare_times(const Trace& expected, const Trace& actual, const std::vector<std::pair<int, int>>& points,
                   Comparison& comparison) {
  if (points.size() == expected.time.size() && points.size() == actual.time.size()) return;
  const LonePoint lone = first_lone_point(expected, actual, points);
  const std::string there = fmt::format("a sample at {} s", lone.time_s);
  const std::string expected_text = lone.is_expected ? there : "",
                    actual_text = lone.is_expected ? "" : there;
  comparison.differences.push_back({"t", lone.time_s, expected_text, actual_text, kNoNumber});
  comparison.lines.push_back({expected_text, actual_text, true});
}

std::string trace_value(double number) { return digits_text(number, 6); }

}  // namespace

void compare_traces(const Trace& expected, const Trace& actual, const ToleranceChain& tolerances,
                    Comparison& comparison) {
  const auto points = common_points(expected, actual);
  if (!length_may_differ(tolerances)) compare_times(expected, actual, points, comparison);
  for (std::size_t c = 0; c < expected.channels.size(); ++c) {
    const std::string& channel = expected.channels[c];
    const auto same = std::find(actual.channels.begin(), actual.channels.end(), channel);
    if (same == actual.channels.end()) {
      comparison.differences.push_back({channel, kNoNumber, "predicted", "no such channel", kNoNumber});
      comparison.lines.push_back({channel + " predicted", "", true});
      continue;
    }
    const auto& there = actual.values[same - actual.channels.begin()];
    const Tolerance tolerance = tolerance_of(tolerances, channel, tolerance_family(channel));
    const ChannelCheck found = check(expected.values[c], there, points, tolerance);
    if (found.count == 0) continue;
    const auto [i, j] = points[found.first];
    const double wanted = expected.values[c][i], got = there[j], time = expected.time[i];
    comparison.differences.push_back(
        {channel, time, trace_value(wanted), trace_value(got), tolerance.allowed(wanted)});
    const auto line = [&, i = i](double number) {
      return fmt::format("{} predicted {} at {} s", channel, trace_value(number), expected.time[i]);
    };
    comparison.lines.push_back(
        {line(wanted), fmt::format("{} ({} of {} points differ)", line(got), found.count, points.size()),
         true});
  }
}

}  // namespace faultline
