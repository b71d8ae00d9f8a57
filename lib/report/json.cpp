// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "lib/core/issue.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/log/time_axis.hpp"
#include "lib/report/stop_report.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

/// No joint is null.
void put_label(Json& json, const FaultLabel& label) {
  json["kind"] = to_string(label.kind);
  json["joint"] = count_or_null(label.joint.number());
}

Json stretch_json(const UnjudgedStretch& stretch) {
  Json json = {{"joint", count_or_null(stretch.joint.number())},
               {"start_s", number_or_null(stretch.start_s)},
               {"end_s", number_or_null(stretch.end_s)},
               {"lacks_position", stretch.lacks_position},
               {"lacks_torque", stretch.lacks_torque}};
  if (stretch.share < 1.0) json["share"] = stretch.share;
  return json;
}

/// Runs only where there are several, stretches only where there are any.
Json log_json(const LogFacts& log) {
  Json json = {{"path", log.path},
               {"sha256", log.sha256},
               {"format", log.format},
               {"rows", log.rows_read},
               {"rows_used", log.rows_used},
               {"joints", log.joints},
               {"start_s", number_or_null(log.start_s)},
               {"end_s", number_or_null(log.end_s)},
               {"sample_period_s", number_or_null(log.sample_period_s)},
               {"issues", list_of<Json>(log.issues.all(), issue_json)}};
  if (log.runs.size() > 1) json["runs"] = list_of<Json>(log.runs, log_run_json);
  if (!log.unjudged.empty()) json["not_judged"] = list_of<Json>(log.unjudged, stretch_json);
  return json;
}

Json model_json(const ModelFacts& model) {
  Json json{
      {"name", model.name}, {"sha256", model.sha256}, {"cases_sha256", text_or_null(model.cases_sha256)}};
  if (!model.notes.empty()) json["notes"] = model.notes;
  return json;
}

Json residual_json(const JointResidual& residual) {
  return {{"joint", residual.joint.number()},
          {"velocity_rms", number_or_null(residual.velocity_rms)},
          {"velocity_peak", number_or_null(residual.velocity_peak)},
          {"peak_s", number_or_null(residual.velocity_peak_s)},
          {"position_rms", number_or_null(residual.position_rms)}};
}

Json condition_json(const ConditionItem& item) {
  return {{"name", item.name},
          {"joint", count_or_null(item.joint.number())},
          {"value", number_or_null(item.value)},
          {"ci95", {number_or_null(item.ci95[0]), number_or_null(item.ci95[1])}},
          {"normal_range", number_or_null(item.normal_range)},
          {"unit", item.unit},
          {"beyond", item.is_beyond()}};
}

/// Null for a log that the torque balance did not judge.
Json score_json(const EvidenceScore& score) {
  if (!score.is_known()) return nullptr;
  Json json;
  put_label(json, score.label);
  json["evidence_nats"] = number_or_null(score.evidence);
  json["limit_nats"] = number_or_null(score.limit);
  json["ratio"] = number_or_null(score.ratio());
  return json;
}

Json opinion_json(const Opinion& opinion) {
  Json json;
  put_label(json, opinion.label);
  json["confidence"] = number_or_null(opinion.confidence);
  return json;
}

Json feature_json(const PrecedentFeature& feature) {
  return {{"name", feature.name},
          {"what", feature.what},
          {"here", number_or_null(feature.here)},
          {"there", number_or_null(feature.there)},
          {"unit", text_or_null(feature.unit)},
          {"difference", number_or_null(feature.difference)}};
}

Json origin_json(const Precedent& precedent) {
  return {{"kind", to_string(precedent.origin)},      {"text", precedent.origin_text},
          {"log", text_or_null(precedent.log)},       {"robot", text_or_null(precedent.robot)},
          {"person", text_or_null(precedent.person)}, {"date", text_or_null(precedent.date)}};
}

Json precedent_json(const Precedent& precedent) {
  Json json;
  json["case"] = precedent.case_id;
  put_label(json, precedent.label);
  json["similarity"] = number_or_null(precedent.similarity);
  json["what_was_done"] = text_or_null(precedent.what_was_done);
  json["origin"] = origin_json(precedent);
  json["voted"] = precedent.voted;
  json["alike"] = list_of<Json>(precedent.alike, feature_json);
  json["unlike"] = list_of<Json>(precedent.unlike, feature_json);
  return json;
}

Json alternative_json(const Alternative& alternative) {
  Json json;
  put_label(json, alternative.label);
  json["why"] = alternative.why;
  return json;
}

Json evidence_json(const EvidenceItem& item) {
  return {{"name", item.name},
          {"value", number_or_null(item.value)},
          {"unit", text_or_null(item.unit)},
          {"text", item.text}};
}

Json episode_json(const EpisodeFacts& episode) {
  Json features = Json::object();
  for (const auto& [name, value] : episode.features) features[name] = number_or_null(value);
  return {{"evidence", number_or_null(episode.evidence)}, {"features", features}};
}

/// Null for a kind without a size.
Json extent_json(const FaultExtent& extent) {
  if (extent.unit.empty()) return nullptr;
  return {{"value", number_or_null(extent.size)},
          {"least", number_or_null(extent.least_size)},
          {"unit", extent.unit}};
}

Json small_change_json(const FaultFinding& change) {
  Json json;
  put_label(json, change.label);
  json["onset_s"] = number_or_null(change.onset_s);
  json["end_s"] = number_or_null(change.end_s);
  json["confidence"] = number_or_null(change.confidence);
  json["size"] = extent_json(change.extent);
  return json;
}

Json fault_json(const FaultFinding& fault) {
  Json json = {{"id", fault.id}};
  put_label(json, fault.label);
  json["onset_s"] = number_or_null(fault.onset_s);
  json["alarm_s"] = number_or_null(fault.alarm_s);
  json["end_s"] = number_or_null(fault.end_s);
  if (fault.run > 0) {
    json["run"] = fault.run;
    json["clock_offset_s"] = number_or_null(fault.clock_offset_s);
  }
  json["confidence"] = number_or_null(fault.confidence);
  json["size"] = extent_json(fault.extent);
  json["opinions"] = {{"mlp", opinion_json(fault.mlp)}, {"rbfn", opinion_json(fault.rbfn)}};
  json["decided_by"] = to_string(fault.decided_by);
  json["precedents"] = list_of<Json>(fault.precedents, precedent_json);
  json["could_also_be"] = list_of<Json>(fault.could_also_be, alternative_json);
  json["evidence"] = list_of<Json>(fault.evidence, evidence_json);
  json["next_check"] = fault.next_check;
  json["episode"] = episode_json(fault.episode);
  return json;
}

}  // namespace

std::string render_json(const Diagnosis& diagnosis) {
  Json json = {{"schema", "faultline/diagnosis/1"},
               {"log", log_json(diagnosis.log)},
               {"model", model_json(diagnosis.model)},
               {"program", {{"version", diagnosis.program_version}}},
               {"verdict", to_string(diagnosis.verdict)},
               {"verdict_reason", text_or_null(diagnosis.verdict_reason)},
               {"score", score_json(diagnosis.score)},
               {"faults", list_of<Json>(diagnosis.faults, fault_json)},
               {"small_changes", list_of<Json>(diagnosis.small_changes, small_change_json)},
               {"condition", list_of<Json>(diagnosis.condition, condition_json)},
               {"residuals", list_of<Json>(diagnosis.residuals, residual_json)},
               {"cannot_see",
                list_of<Json>(diagnosis.cannot_see, [](const std::string& text) { return Json(text); })}};
  if (diagnosis.stop) json["stop"] = stop_json(*diagnosis.stop);
  return json_text(json);
}

}  // namespace faultline
