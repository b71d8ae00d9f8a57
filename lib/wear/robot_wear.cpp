// SPDX-License-Identifier: MIT
#include "lib/wear/robot_wear.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <tuple>

#include "lib/core/text.hpp"
#include "lib/diagnose/condition_words.hpp"

namespace faultline {
namespace {

constexpr double kEpoch = 1e9;      // s: a start time above it is seconds since 1970 (from 2001 on)
constexpr double kLastDate = 1e11;  // s: no date lies beyond it (the year 5138)
constexpr double kDay = 86400.0;    // s

bool is_usable(const ParameterValue& value) {
  return std::isfinite(value.value) && std::isfinite(value.std) && value.std > 0.0;
}

void add_points(std::map<std::string, ConditionSeries>& all, const RobotWear& wear, std::size_t log) {
  const WearLog& one = wear.logs[log];
  for (const ParameterValue& value : one.condition) {
    if (!is_usable(value)) continue;
    ConditionSeries& series = all[value.name];
    series.name = value.name;
    series.unit = value.unit;
    series.logs.push_back(log);
    const double at =
        wear.by_date ? (one.start_s - wear.logs.front().start_s) / kDay : static_cast<double>(log + 1);
    series.points.push_back({at, value.value, value.std});
  }
}

/// By kind and joint, as a reader expects them: joint 10 after joint 9.
std::tuple<std::string, std::size_t, std::string> place_of(const ConditionSeries& series) {
  const std::size_t end = series.name.find_last_not_of("0123456789") + 1;
  return {series.name.substr(0, end), series.name.size(), series.name};
}

}  // namespace

bool is_date(double start_s) { return start_s >= kEpoch && start_s < kLastDate; }

std::string date_text(double start_s) {
  if (!is_date(start_s)) return "";
  const auto days = std::chrono::days(static_cast<int>(std::floor(start_s / kDay)));
  const std::chrono::year_month_day date{std::chrono::sys_days(days)};
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()));
}

RobotWear robot_wear(const std::string& robot, const std::string& model_sha256, std::vector<WearLog> logs) {
  RobotWear wear;
  wear.robot = robot;
  wear.model_sha256 = model_sha256;
  std::erase_if(logs, [](const WearLog& log) {
    return std::none_of(log.condition.begin(), log.condition.end(), is_usable);
  });
  wear.by_date = !logs.empty() && std::all_of(logs.begin(), logs.end(),
                                              [](const WearLog& log) { return is_date(log.start_s); });
  if (wear.by_date)
    std::stable_sort(logs.begin(), logs.end(),
                     [](const WearLog& a, const WearLog& b) { return a.start_s < b.start_s; });
  wear.logs = std::move(logs);
  if (wear.logs.empty()) wear.not_applicable = "no log determines an item of the condition";
  std::map<std::string, ConditionSeries> all;
  for (std::size_t i = 0; i < wear.logs.size(); ++i) add_points(all, wear, i);
  for (auto& [name, series] : all) {
    series.what = condition_words(name);
    series.trend = series_trend(series.points, kWearFalseAlarms / static_cast<double>(all.size()));
    wear.series.push_back(std::move(series));
  }
  std::sort(wear.series.begin(), wear.series.end(),
            [](const ConditionSeries& a, const ConditionSeries& b) { return place_of(a) < place_of(b); });
  return wear;
}

const ConditionSeries* leading_series(const RobotWear& wear) {
  const ConditionSeries* leading = nullptr;
  std::tuple<int, double> best;
  for (const ConditionSeries& series : wear.series) {
    const SeriesTrend& trend = series.trend;
    std::tuple<int, double> place{trend.is_trend ? 1 : 2, trend.p};
    for (const SeriesChange& change : trend.changes) place = std::min(place, {0, change.p});
    if (leading && !(place < best)) continue;
    leading = &series;
    best = place;
  }
  return leading;
}

}  // namespace faultline
