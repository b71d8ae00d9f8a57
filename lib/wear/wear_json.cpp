// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "lib/core/json_values.hpp"
#include "lib/core/statistics.hpp"
#include "lib/wear/robot_wear.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

Json pair_json(const std::array<double, 2>& values) {
  return {number_or_null(values[0]), number_or_null(values[1])};
}

Json log_json(const RobotWear& wear, const ConditionSeries& series, int point) {
  const WearLog& log = wear.logs[series.logs[static_cast<std::size_t>(point)]];
  return {{"log", log.log}, {"start_s", number_or_null(log.start_s)}};
}

Json point_json(const RobotWear& wear, const ConditionSeries& series, int point) {
  const SeriesPoint& at = series.points[static_cast<std::size_t>(point)];
  Json json = log_json(wear, series, point);
  json["value"] = number_or_null(at.value);
  json["ci95"] = pair_json({at.value - kNormal95 * at.std, at.value + kNormal95 * at.std});
  return json;
}

Json trend_json(const RobotWear& wear, const ConditionSeries& series) {
  const SeriesTrend& trend = series.trend;
  if (!trend.not_applicable.empty()) return {{"not_applicable", trend.not_applicable}};
  return {{"slope", number_or_null(trend.slope)},
          {"ci95", pair_json(trend.slope_ci95)},
          {"per", wear.step()},
          {"beyond_chance", trend.is_trend},
          {"p", number_or_null(trend.p)},
          {"since", log_json(wear, series, trend.first)},
          {"between_std", number_or_null(trend.between_std)}};
}

Json change_json(const RobotWear& wear, const ConditionSeries& series, const SeriesChange& change) {
  return {{"from", log_json(wear, series, change.first)},
          {"before", log_json(wear, series, change.first - 1)},
          {"earliest", log_json(wear, series, change.first_between[0])},
          {"latest", log_json(wear, series, change.first_between[1])},
          {"size", number_or_null(change.size)},
          {"ci95", pair_json(change.ci95)},
          {"beside_trend", change.beside_trend},
          {"p", number_or_null(change.p)}};
}

Json series_json(const RobotWear& wear, const ConditionSeries& series, bool with_values) {
  const int points = static_cast<int>(series.points.size());
  Json json = {
      {"name", series.name},
      {"unit", series.unit},
      {"logs", points},
      {"last", point_json(wear, series, points - 1)},
      {"trend", trend_json(wear, series)},
      {"changes", list_of<Json>(series.trend.changes,
                                [&](const SeriesChange& c) { return change_json(wear, series, c); })},
      {"outliers",
       list_of<Json>(series.trend.outliers, [&](int point) { return log_json(wear, series, point); })}};
  if (!with_values) return json;
  json["values"] = Json::array();
  for (int i = 0; i < points; ++i) json["values"].push_back(point_json(wear, series, i));
  return json;
}

}  // namespace

Json to_json(const RobotWear& wear, bool with_values) {
  return {{"robot", wear.robot},
          {"model_sha256", text_or_null(wear.model_sha256)},
          {"order", wear.by_date ? "date" : "given"},
          {"not_applicable", text_or_null(wear.not_applicable)},
          {"false_alarms", kWearFalseAlarms},
          {"logs", wear.logs.size()},
          {"series", list_of<Json>(wear.series, [&](const ConditionSeries& series) {
             return series_json(wear, series, with_values);
           })}};
}

}  // namespace faultline
