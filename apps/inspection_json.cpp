// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/inspection.hpp"
#include "lib/core/utf8.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json row(std::int64_t value) { return value > 0 ? Json(value) : Json(nullptr); }

Json channel_json(const InspectedChannel& channel) {
  const ChannelSummary& summary = channel.summary;
  return {{"name", valid_utf8(summary.name)}, {"column", valid_utf8(channel.column)},
          {"unit", valid_utf8(channel.unit)}, {"canonical", summary.canonical},
          {"min", number(summary.min)},       {"max", number(summary.max)},
          {"values", summary.values},         {"missing", summary.missing},
          {"constant", summary.constant()}};
}

Json issue_json(const Issue& issue) {
  return {{"code", issue.code},
          {"channel", issue.channel.empty() ? Json(nullptr) : Json(valid_utf8(issue.channel))},
          {"severity", to_string(issue.severity)},
          {"message", valid_utf8(issue.message)},
          {"first_row", row(issue.first_row)},
          {"first_time_s", number(issue.first_time_s)},
          {"count", issue.count},
          {"rows_dropped", issue.rows_dropped}};
}

}  // namespace

Json inspection_json(const Inspection& inspection) {
  const TimeAxis& time = inspection.quality.time;
  Json json{{"path", valid_utf8(inspection.log.path)},
            {"sha256", inspection.log.sha256},
            {"format", inspection.log.format},
            {"joint_log", inspection.joint_log},
            {"joints", inspection.joints},
            {"rows", inspection.log.rows_read},
            {"rows_used", inspection.rows_used},
            {"start_s", number(time.start_s)},
            {"end_s", number(time.end_s)},
            {"sample_period_s", number(time.period_s)}};
  json["channels"] = Json::array();
  for (const InspectedChannel& channel : inspection.channels)
    json["channels"].push_back(channel_json(channel));
  json["lacking"] = inspection.lacking;
  json["issues"] = Json::array();
  for (const Issue& issue : inspection.issues.all()) json["issues"].push_back(issue_json(issue));
  return json;
}

}  // namespace faultline
