// SPDX-License-Identifier: MIT
#include "lib/golden/run_json.hpp"

#include <nlohmann/json.hpp>

#include "lib/core/json_values.hpp"
#include "lib/core/utf8.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

Json text(const std::string& value) { return valid_utf8(value); }

Json json_of(const Difference& d) {
  return {{"channel", text(d.channel)},
          {"time_s", number_or_null(d.time_s)},
          {"expected", text(d.expected)},
          {"actual", text(d.actual)},
          {"allowed", number_or_null(d.allowed)}};
}

Json json_of(const CheckedItem& item) {
  Json json{{"name", text(item.name)},
            {"result", !item.damage.empty() ? "damaged"
                       : item.same()        ? "same"
                                            : "different"},
            {"verdict_changes", item.changes_verdict()},
            {"damage", item.damage.empty() ? Json(nullptr) : text(item.damage)}};
  const Difference* first = first_divergence(item.comparison);
  json["first_divergence"] = first ? json_of(*first) : Json(nullptr);
  json["differences"] = Json::array();
  for (const Difference& d : item.comparison.differences) json["differences"].push_back(json_of(d));
  return json;
}

Json json_of(const FaultLabel& label) {
  return {{"kind", to_string(label.kind)}, {"joint", label.joint}};  // 0 for none in this schema
}

Json json_of(const Opinion& opinion) {
  Json json = json_of(opinion.label);
  json["confidence"] = number_or_null(opinion.confidence);
  return json;
}

Json json_of(const ObservedEvent& event) {
  Json json = to_json(event);
  json["joint"] = event.label.joint;
  json["evidence"] = number_or_null(event.evidence);
  json["decided_by"] = event.decided_by;
  json["mlp"] = json_of(event.opinions.mlp);
  json["rbfn"] = json_of(event.opinions.rbfn);
  json["could_also_be"] = Json::array();
  for (const FaultLabel& label : event.could_also_be) json["could_also_be"].push_back(json_of(label));
  return json;
}

Json json_of(const JointResidual& r) {
  return {{"joint", r.joint},
          {"velocity_rms", number_or_null(r.velocity_rms)},
          {"velocity_peak", number_or_null(r.velocity_peak)},
          {"peak_s", number_or_null(r.velocity_peak_s)},
          {"position_rms", number_or_null(r.position_rms)}};
}

Json json_of(const Trace& trace) {
  Json values = Json::array();
  for (const auto& channel : trace.values) values.push_back(numbers_or_null(channel));
  return {{"channels", trace.channels}, {"time", numbers_or_null(trace.time)}, {"values", values}};
}

Json json_of(const GoldenRun::Log& log) {
  const Observation& o = log.observation;
  Json json{{"name", text(log.name)}, {"verdict", o.verdict}, {"reason", text(o.reason)}, {"rows", o.rows}};
  json["events"] = Json::array();
  for (const ObservedEvent& event : o.events) json["events"].push_back(json_of(event));
  json["residuals"] = Json::array();
  for (const JointResidual& r : o.residuals) json["residuals"].push_back(json_of(r));
  json["trace"] = json_of(o.trace);
  return json;
}

Json json_of(const std::vector<ParameterValue>& values) {
  Json json = Json::array();
  for (const ParameterValue& p : values)
    json.push_back({{"name", text(p.name)},
                    {"value", number_or_null(p.value)},
                    {"std", number_or_null(p.std)},
                    {"unit", text(p.unit)}});
  return json;
}

Json json_of(const ObservedIdentification& identification) {
  Json json{{"status", identification.status},
            {"method", identification.method},
            {"reason", text(identification.reason)}};
  json["parameters"] = json_of(identification.parameters);
  return json;
}

}  // namespace

std::string render_check_json(const GoldenCheck& check, const GoldenRun& run) {
  Json json{{"schema", "faultline/golden-check/1"},
            {"result", check.damaged() ? "damaged"
                       : check.same()  ? "same"
                                       : "different"},
            {"program", {{"version", run.program_version}}},
            {"model",
             {{"name", text(run.model.name)},
              {"sha256", run.model.sha256},
              {"cases_sha256", run.model.cases_sha256},
              {"values", json_of(run.model_values)}}}};
  json["items"] = Json::array();
  for (const CheckedItem& item : check.items) json["items"].push_back(json_of(item));
  json["logs"] = Json::array();
  for (const GoldenRun::Log& log : run.logs) json["logs"].push_back(json_of(log));
  json["identification"] = run.identification ? json_of(*run.identification) : Json(nullptr);
  return json.dump(1) + "\n";
}

}  // namespace faultline
