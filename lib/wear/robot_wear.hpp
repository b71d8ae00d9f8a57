// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lib/identify/identification.hpp"
#include "lib/wear/series_trend.hpp"

namespace faultline {

/// A log of a robot, with the items of its condition that it determines.
struct WearLog {
  std::string log;  ///< its name
  double start_s = std::numeric_limits<double>::quiet_NaN();
  std::vector<ParameterValue> condition;  ///< by name, such as "friction_1"
};

/// One item of the condition over the logs that determine it.
struct ConditionSeries {
  std::string name, what, unit;     ///< "friction_1", "friction of joint 1", "%"
  std::vector<std::size_t> logs;    ///< of RobotWear::logs, a point each
  std::vector<SeriesPoint> points;  ///< `at` in days since the first log, or the place among the logs from 1
  SeriesTrend trend;
};

/// The condition of one robot over its logs, all against the same model: two models count from different
/// zeros.
struct RobotWear {
  std::string robot;  ///< name of the model
  std::string model_sha256;
  bool by_date = false;        ///< false: some log has no date, so that trends are by the order of the logs
  std::string not_applicable;  ///< why there are no series, a sentence; empty if there are
  std::vector<WearLog> logs;   ///< in the order of the series
  std::vector<ConditionSeries> series;

  /// "day" or "log".
  const char* step() const { return by_date ? "day" : "log"; }
};

/// Probability that a robot without any change has one in any of its series; likewise of a trend beyond
/// chance.
inline constexpr double kWearFalseAlarms = 0.01;

/// Whether a start time is a date, seconds since 1970, and not a clock of the controller.
bool is_date(double start_s);
/// Returns the day in UTC, "2026-03-04"; empty if the time is no date.
std::string date_text(double start_s);

/// Returns trend and changes of each item of the condition. Logs are sorted by date if all with a condition
/// have one, else their order is kept.
RobotWear robot_wear(const std::string& robot, const std::string& model_sha256, std::vector<WearLog> logs);

/// The series that a reader should see first: one with a change, then one with a trend beyond chance, each
/// the least probable by chance; null without series.
const ConditionSeries* leading_series(const RobotWear& wear);

// Words, with values in the unit of the series.
std::string trend_words(const RobotWear& wear, const ConditionSeries& series);
std::string change_words(const RobotWear& wear, const ConditionSeries& series, const SeriesChange& change);
/// "none beyond chance", or why changes cannot be found; empty if there are some.
std::string no_change_words(const ConditionSeries& series);

/// A line for each change and each trend beyond chance, for a terminal; empty without any.
std::string to_text(const RobotWear& wear);

/// Members of a robot in batch-summary-2 and history-1; `with_values`: the points of each series, too.
nlohmann::ordered_json to_json(const RobotWear& wear, bool with_values);

/// Returns a table for a page: a row an item of the condition, with its course.
std::string wear_table(const RobotWear& wear);
/// Returns a small picture of the values, the line of the trend and the changes, as SVG.
std::string course_picture(const ConditionSeries& series);

}  // namespace faultline
