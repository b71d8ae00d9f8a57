// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "apps/inspection.hpp"
#include "lib/core/issue_json.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/utf8.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

Json channel_json(const InspectedChannel& channel) {
  const ChannelSummary& summary = channel.summary;
  return {{"name", valid_utf8(summary.name)},   {"column", valid_utf8(channel.column)},
          {"unit", valid_utf8(channel.unit)},   {"canonical", summary.canonical},
          {"min", number_or_null(summary.min)}, {"max", number_or_null(summary.max)},
          {"values", summary.values},           {"missing", summary.missing},
          {"constant", summary.constant()}};
}

Json valid_issue_json(Issue issue) {
  issue.channel = valid_utf8(issue.channel);
  issue.message = valid_utf8(issue.message);
  return issue_json(issue);
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
            {"start_s", number_or_null(time.start_s)},
            {"end_s", number_or_null(time.end_s)},
            {"sample_period_s", number_or_null(time.period_s)}};
  json["channels"] = list_of<Json>(inspection.channels, channel_json);
  json["lacking"] = inspection.lacking;
  json["issues"] = list_of<Json>(inspection.issues.all(), valid_issue_json);
  return json;
}

}  // namespace faultline
