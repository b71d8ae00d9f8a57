// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/condition.hpp"
#include "lib/wear/robot_wear.hpp"

namespace faultline {
namespace {

std::string interval_words(const std::array<double, 2>& ci95) {
  return fmt::format("({} to {})", value_text(ci95[0]), value_text(ci95[1]));
}

const WearLog& log_at(const RobotWear& wear, const ConditionSeries& series, int point) {
  return wear.logs[series.logs[static_cast<std::size_t>(point)]];
}

/// "2026-03-04, runs/17.csv", or the name alone.
std::string log_words(const RobotWear& wear, const ConditionSeries& series, int point) {
  const WearLog& log = log_at(wear, series, point);
  const std::string name = shortened(log.log, kLongestName);
  return wear.by_date ? date_text(log.start_s) + ", " + name : name;
}

}  // namespace

std::string trend_words(const RobotWear& wear, const ConditionSeries& series) {
  const SeriesTrend& trend = series.trend;
  if (!trend.not_applicable.empty()) return "not applicable: " + trend.not_applicable;
  return fmt::format("{} per {} {}{}", condition_value_text(trend.slope, series.unit), wear.step(),
                     interval_words(trend.slope_ci95), trend.is_trend ? ", beyond chance" : "");
}

std::string change_words(const RobotWear& wear, const ConditionSeries& series, const SeriesChange& change) {
  std::string words = fmt::format("{} {} from {} on", condition_value_text(change.size, series.unit),
                                  interval_words(change.ci95), log_words(wear, series, change.first));
  const auto& [low, high] = change.first_between;
  if (low < high)
    words += fmt::format(" (between {} and {})", log_words(wear, series, low), log_words(wear, series, high));
  return words;
}

std::string no_change_words(const ConditionSeries& series) {
  if (!series.trend.changes.empty()) return "";
  const int least = 2 * kLogsBesideChange;
  if (static_cast<int>(series.points.size()) >= least) return "none beyond chance";
  return fmt::format("not applicable: {} {}, {} are needed",
                     counted(static_cast<long long>(series.points.size()), "log"),
                     series.points.size() == 1 ? "determines it" : "determine it", least);
}

std::string to_text(const RobotWear& wear) {
  std::string text;
  for (const ConditionSeries& series : wear.series) {
    const std::string begin =
        fmt::format("  {}: {}: ", shortened(wear.robot, kLongestName), printable(series.what));
    for (const SeriesChange& change : series.trend.changes)
      text += begin + "changed by " + change_words(wear, series, change) + "\n";
    if (series.trend.is_trend) text += begin + "trend " + trend_words(wear, series) + "\n";
  }
  return text;
}

}  // namespace faultline
