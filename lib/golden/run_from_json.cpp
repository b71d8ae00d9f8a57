// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/core/json_values.hpp"
#include "lib/golden/run_json.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

JointResidual residual(const Json& json) {
  return {json.at("joint").get<int>(), number_or_nan(json.at("velocity_rms")),
          number_or_nan(json.at("velocity_peak")), number_or_nan(json.at("peak_s")),
          number_or_nan(json.at("position_rms"))};
}

Trace trace(const Json& json, const std::string& where) {
  Trace read;
  read.channels = json.at("channels").get<std::vector<std::string>>();
  read.time = numbers_or_nan(json.at("time"));
  for (const Json& values : json.at("values")) read.values.push_back(numbers_or_nan(values));
  bool fits = read.values.size() == read.channels.size();
  for (const auto& values : read.values) fits &= values.size() == read.time.size();
  if (!fits) throw Error(ErrorCode::input, where, "has a trace whose channels differ in length");
  return read;
}

FaultLabel label(const Json& json) {
  return {fault_kind_from(json.at("kind").get<std::string>()), json.at("joint").get<int>()};
}

Opinion opinion(const Json& json) { return {label(json), number_or_nan(json.at("confidence"))}; }

ObservedEvent event(const Json& json) {
  ObservedEvent read{fault_event_from_json(json)};
  read.evidence = number_or_nan(json.at("evidence"));
  read.decided_by = json.at("decided_by");
  read.opinions = {opinion(json.at("mlp")), opinion(json.at("rbfn"))};
  for (const Json& one : json.at("could_also_be")) read.could_also_be.push_back(label(one));
  return read;
}

std::vector<ParameterValue> values(const Json& json) {
  std::vector<ParameterValue> read;
  for (const Json& p : json)
    read.push_back({p.at("name"), number_or_nan(p.at("value")), number_or_nan(p.at("std")), p.at("unit")});
  return read;
}

GoldenRun::Log log(const Json& json, const std::string& where) {
  GoldenRun::Log read{json.at("name"), {}};
  Observation& o = read.observation;
  o.verdict = json.at("verdict");
  o.reason = json.at("reason");
  o.rows = json.at("rows");
  for (const Json& one : json.at("events")) o.events.push_back(event(one));
  for (const Json& one : json.at("residuals")) o.residuals.push_back(residual(one));
  o.trace = trace(json.at("trace"), where);
  return read;
}

ObservedIdentification identification(const Json& json) {
  ObservedIdentification read{json.at("status"), json.at("method"), {}, json.at("reason")};
  read.parameters = values(json.at("parameters"));
  return read;
}

GoldenRun run(const Json& json, const std::string& where) {
  if (json.at("schema") != "faultline/golden-check/1")
    throw Error(
        ErrorCode::input, where,
        "has another schema, this program reads faultline/golden-check/1; write it again with faultline "
        "golden check --json");
  GoldenRun read;
  read.program_version = json.at("program").at("version");
  const Json& model = json.at("model");
  read.model = {model.at("name"), model.at("sha256"), model.at("cases_sha256")};
  read.model_values = values(model.at("values"));
  for (const Json& one : json.at("logs")) read.logs.push_back(log(one, where));
  if (!json.at("identification").is_null()) read.identification = identification(json.at("identification"));
  return read;
}

}  // namespace

GoldenRun run_from_json(const std::string& text, const std::string& where) {
  try {
    return run(Json::parse(text), where);
  } catch (const Json::exception&) {
    throw Error(ErrorCode::input, where,
                "is not an output of faultline golden check --json, or it is truncated; write it again");
  }
}

}  // namespace faultline
