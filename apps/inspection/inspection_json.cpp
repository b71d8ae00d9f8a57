// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/inspection/inspection.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/core/text.hpp"
#include "lib/log/time_axis.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

Json same_value_json(const SameValue& same) {
  if (same.rows == 0) return nullptr;
  return {{"rows", same.rows},
          {"value", number_or_null(same.value)},
          {"start_s", number_or_null(same.start_s)},
          {"length_s", number_or_null(same.length_s)},
          {"joint_moved", number_or_null(same.moved)}};
}

/// Returns the members of a channel with those of the checkup, which only canonical channels have.
Json channel_json(const InspectedChannel& channel, const Inspection& inspection) {
  const ChannelSummary& summary = channel.summary;
  Json json{{"name", valid_utf8(summary.name)},
            {"column", valid_utf8(channel.column)},
            {"unit", valid_utf8(channel.unit)},
            {"canonical", summary.canonical},
            {"min", number_or_null(summary.min)},
            {"max", number_or_null(summary.max)},
            {"values", summary.values},
            {"missing", summary.missing},
            {"constant", summary.constant()},
            {"at_min", summary.at_min},
            {"at_max", summary.at_max}};
  const ChannelCheckup* found = inspection.checkup_of(summary.name, summary.canonical);
  if (!found) return json;
  json["step"] = number_or_null(found->course.step.value_or(std::nan("")));
  json["longest_unchanged"] = same_value_json(found->course.longest);
  json["unchanged_while_moving"] = same_value_json(found->course.while_moving);
  json["longest_at_min"] = same_value_json(found->course.at_min);
  json["longest_at_max"] = same_value_json(found->course.at_max);
  return json;
}

Json time_json(const Inspection& inspection) {
  const TimeAxis& time = inspection.quality.time;
  Json json{{"jitter_rms_s", number_or_null(time.jitter_s)},
            {"jitter_largest_s", number_or_null(time.largest_jitter_s)},
            {"uneven_steps", time.uneven_steps},
            {"gaps", time.gaps},
            {"in_gaps_s", number_or_null(time.in_gaps_s)}};
  json["listed_gaps"] = list_of<Json>(time.listed_gaps, [](const TimeGap& gap) {
    return Json{{"after_row", gap.row}, {"start_s", gap.start_s}, {"length_s", gap.length_s}};
  });
  json["period_changes"] = list_of<Json>(inspection.checkup.clock_changes, [](const PeriodChange& change) {
    return Json{{"at_s", change.at_s},
                {"row", change.row},
                {"before_s", change.before_s},
                {"after_s", change.after_s}};
  });
  return json;
}

Json joint_json(const JointCheckup& joint) {
  return {{"velocity_rms", number_or_null(joint.velocity.rms)},
          {"velocity_to_difference", number_or_null(joint.velocity.rms_ratio)},
          {"velocity_delay_rows", number_or_null(joint.velocity.delay_rows)},
          {"velocity_is_difference", joint.velocity.is_difference},
          {"torque_correlation", number_or_null(joint.torque.correlation)},
          {"torque_delay_rows", number_or_null(joint.torque.delay_rows)},
          {"torque_delay_doubt_rows", number_or_null(joint.torque.delay_uncertainty_rows)},
          {"torque_explained", number_or_null(joint.torque.explained)},
          {"torque_per_acceleration", number_or_null(joint.torque.inertia)}};
}

Json analysis_json(const PossibleAnalysis& analysis) {
  return {{"name", analysis.name},
          {"fit", to_string(analysis.fit)},
          {"channels", analysis.channels},
          {"why", analysis.why},
          {"help", analysis.help}};
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
  if (inspection.log.runs.size() > 1) json["runs"] = list_of<Json>(inspection.log.runs, log_run_json);
  json["channels"] = list_of<Json>(inspection.channels, [&](const InspectedChannel& channel) {
    return channel_json(channel, inspection);
  });
  json["lacking"] = inspection.lacking;
  json["issues"] = list_of<Json>(inspection.issues.all(), valid_issue_json);
  json["verdict"] = verdict_of(inspection);
  json["share_used"] = number_or_null(inspection.share_used());
  json["completeness"] = number_or_null(inspection.completeness());
  json["time"] = time_json(inspection);
  const RepeatedRowCount& repeated = inspection.checkup.repeated.all;
  json["repeated_rows"] = {{"rows", repeated.rows}, {"held", repeated.held}, {"longest", repeated.longest}};
  json["by_joint"] = list_of<Json>(inspection.checkup.joints, joint_json);
  json["analyses"] = list_of<Json>(inspection.analyses, analysis_json);
  return json;
}

std::string inspections_json(const std::vector<Inspection>& inspections) {
  return json_text(
      Json{{"schema", "faultline/inspection/1"}, {"logs", list_of<Json>(inspections, inspection_json)}});
}

}  // namespace faultline
