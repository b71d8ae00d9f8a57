// SPDX-License-Identifier: MIT
#include "lib/report/json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

/// Joint 0 (the fault belongs to no joint) is null.
void put_label(Json& json, const FaultLabel& label) {
  json["kind"] = to_string(label.kind);
  json["joint"] = label.joint > 0 ? Json(label.joint) : Json(nullptr);
}

template <typename Items, typename Render>
Json list(const Items& items, Render render) {
  Json json = Json::array();
  for (const auto& item : items) json.push_back(render(item));
  return json;
}

Json issue_json(const Issue& issue) {
  return {{"code", issue.code},
          {"channel", text_or_null(issue.channel)},
          {"severity", to_string(issue.severity)},
          {"message", issue.message},
          {"first_row", issue.first_row > 0 ? Json(issue.first_row) : Json(nullptr)},
          {"first_time_s", number(issue.first_time_s)},
          {"count", issue.count},
          {"rows_dropped", issue.rows_dropped}};
}

Json log_json(const LogFacts& log) {
  return {{"path", log.path},
          {"sha256", log.sha256},
          {"format", log.format},
          {"rows", log.rows_read},
          {"rows_used", log.rows_used},
          {"joints", log.joints},
          {"start_s", number(log.start_s)},
          {"end_s", number(log.end_s)},
          {"sample_period_s", number(log.sample_period_s)},
          {"issues", list(log.issues.all(), issue_json)}};
}

Json model_json(const ModelFacts& model) {
  return {{"name", model.name}, {"sha256", model.sha256}, {"cases_sha256", text_or_null(model.cases_sha256)}};
}

Json residual_json(const JointResidual& residual) {
  return {{"joint", residual.joint},
          {"velocity_rms", number(residual.velocity_rms)},
          {"velocity_peak", number(residual.velocity_peak)},
          {"peak_s", number(residual.velocity_peak_s)},
          {"position_rms", number(residual.position_rms)}};
}

Json opinion_json(const Opinion& opinion) {
  Json json;
  put_label(json, opinion.label);
  json["confidence"] = number(opinion.confidence);
  return json;
}

Json precedent_json(const Precedent& precedent) {
  Json json;
  json["case"] = precedent.case_id;
  put_label(json, precedent.label);
  json["similarity"] = number(precedent.similarity);
  json["what_was_done"] = text_or_null(precedent.what_was_done);
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
          {"value", number(item.value)},
          {"unit", text_or_null(item.unit)},
          {"text", item.text}};
}

Json episode_json(const EpisodeFacts& episode) {
  Json features = Json::object();
  for (const auto& [name, value] : episode.features) features[name] = number(value);
  return {{"evidence", number(episode.evidence)}, {"features", features}};
}

Json fault_json(const FaultFinding& fault) {
  Json json = {{"id", fault.id}};
  put_label(json, fault.label);
  json["onset_s"] = number(fault.onset_s);
  json["alarm_s"] = number(fault.alarm_s);
  json["end_s"] = number(fault.end_s);
  json["confidence"] = number(fault.confidence);
  json["opinions"] = {{"mlp", opinion_json(fault.mlp)}, {"rbfn", opinion_json(fault.rbfn)}};
  json["decided_by"] = to_string(fault.decided_by);
  json["precedents"] = list(fault.precedents, precedent_json);
  json["could_also_be"] = list(fault.could_also_be, alternative_json);
  json["evidence"] = list(fault.evidence, evidence_json);
  json["next_check"] = fault.next_check;
  json["episode"] = episode_json(fault.episode);
  return json;
}

}  // namespace

std::string render_json(const Diagnosis& diagnosis) {
  const Json json = {
      {"schema", "faultline/diagnosis/1"},
      {"log", log_json(diagnosis.log)},
      {"model", model_json(diagnosis.model)},
      {"program", {{"version", diagnosis.program_version}}},
      {"verdict", to_string(diagnosis.verdict)},
      {"verdict_reason", text_or_null(diagnosis.verdict_reason)},
      {"faults", list(diagnosis.faults, fault_json)},
      {"residuals", list(diagnosis.residuals, residual_json)},
      {"cannot_see", list(diagnosis.cannot_see, [](const std::string& text) { return Json(text); })}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace faultline
