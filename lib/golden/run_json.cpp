// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/core/json/json_fields.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/fault_event.hpp"
#include "lib/fault/label_fields.hpp"
#include "lib/golden/check.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kRunSchema = "faultline/golden-check/1";

template <typename Checked>
const char* result_of(const Checked& checked, bool damaged) {
  return damaged ? "damaged" : checked.same() ? "same" : "different";
}

Json json_of(const Difference& d) {
  return {{"channel", valid_utf8(d.channel)},
          {"time_s", number_or_null(d.time_s)},
          {"expected", valid_utf8(d.expected)},
          {"actual", valid_utf8(d.actual)},
          {"allowed", number_or_null(d.allowed)}};
}

Json json_of(const CheckedItem& item) {
  const Difference* first = first_divergence(item.comparison);
  return {{"name", valid_utf8(item.name)},
          {"result", result_of(item, !item.damage.empty())},
          {"verdict_changes", item.changes_verdict()},
          {"damage", text_or_null(valid_utf8(item.damage))},
          {"first_divergence", first ? json_of(*first) : Json(nullptr)},
          {"differences",
           list_of<Json>(item.comparison.differences, [](const Difference& d) { return json_of(d); })}};
}

}  // namespace

void fields(auto& v, MaybeConst<ObservedEvent> auto& event) {
  fields(v, base_part<FaultEvent>(event));
  v("joint", event.label.joint);  // 0 for none in this schema
  v("evidence", event.evidence);
  v("decided_by", event.decided_by);
  fields(v, event.opinions);
  v("could_also_be", event.could_also_be);
}

void fields(auto& v, MaybeConst<JointResidual> auto& r) {
  v("joint", r.joint);
  v("velocity_rms", r.velocity_rms);
  v("velocity_peak", r.velocity_peak);
  v("peak_s", r.velocity_peak_s);
  v("position_rms", r.position_rms);
}

void fields(auto& v, MaybeConst<Trace> auto& trace) {
  v("channels", trace.channels);
  v("time", trace.time);
  v("values", trace.values);
}

void fields(auto& v, MaybeConst<GoldenRun::Log> auto& log) {
  v.text("name", log.name);
  v("verdict", log.observation.verdict);
  v.text("reason", log.observation.reason);
  v("rows", log.observation.rows);
  v("events", log.observation.events);
  v("residuals", log.observation.residuals);
  v("trace", log.observation.trace);
}

void fields(auto& v, MaybeConst<ParameterValue> auto& p) {
  v.text("name", p.name);
  v("value", p.value);
  v("std", p.std);
  v.text("unit", p.unit);
}

void fields(auto& v, MaybeConst<ObservedIdentification> auto& identification) {
  v("status", identification.status);
  v("method", identification.method);
  v.text("reason", identification.reason);
  v("parameters", identification.parameters);
}

namespace {

/// The versions of program and model.
void version_fields(auto& v, MaybeConst<GoldenRun> auto& run) {
  v.object("program", [&](auto& program) { program("version", run.program_version); });
  v.object("model", [&](auto& model) {
    model.text("name", run.model.name);
    model("sha256", run.model.sha256);
    model("cases_sha256", run.model.cases_sha256);
    model("values", run.model_values);
  });
}

/// What the versions say.
void said_fields(auto& v, MaybeConst<GoldenRun> auto& run) {
  v("logs", run.logs);
  v("identification", run.identification);
}

void check_trace(const Trace& trace, const std::string& where) {
  bool fits = trace.values.size() == trace.channels.size();
  for (const auto& values : trace.values) fits &= values.size() == trace.time.size();
  if (!fits) throw Error(ErrorCode::input, where, "has a trace whose channels differ in length");
}

GoldenRun run_of(const Json& json, const std::string& where) {
  if (json.at("schema") != kRunSchema)
    throw Error(
        ErrorCode::input, where,
        "has another schema, this program reads faultline/golden-check/1; write it again with faultline "
        "golden check --json");
  GoldenRun run;
  FieldReader<Json> reader(json, where);
  version_fields(reader, run);
  said_fields(reader, run);
  for (const GoldenRun::Log& log : run.logs) check_trace(log.observation.trace, where);
  return run;
}

}  // namespace

std::string render_check_json(const GoldenCheck& check, const GoldenRun& run) {
  FieldWriter<Json> writer;
  writer("schema", kRunSchema);
  writer("result", result_of(check, check.damaged()));
  version_fields(writer, run);
  writer("items", list_of<Json>(check.items, [](const CheckedItem& item) { return json_of(item); }));
  said_fields(writer, run);
  return writer.json().dump(1) + "\n";
}

GoldenRun run_from_json(const std::string& text, const std::string& where) {
  try {
    return run_of(Json::parse(text), where);
  } catch (const Json::exception&) {
    throw Error(ErrorCode::input, where,
                "is not an output of faultline golden check --json, or it is truncated; write it again");
  }
}

}  // namespace faultline
