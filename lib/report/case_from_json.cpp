// SPDX-License-Identifier: MIT
#include "lib/report/case_from_json.hpp"

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/core/files/inner_file.hpp"
#include "lib/core/json_values.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

FaultLabel label_from(const Json& json) {
  return {fault_kind_from(json.at("kind").get<std::string>()),
          Joint::numbered(count_or_zero(json.at("joint")))};
}

Opinion opinion_from(const Json& json) { return {label_from(json), json.at("confidence").get<double>()}; }

const Json& fault_with_id(const Json& diagnosis, const std::string& where, int id) {
  for (const Json& fault : diagnosis.at("faults"))
    if (fault.at("id") == id) return fault;
  if (diagnosis.at("faults").empty())
    throw Error(ErrorCode::usage, where, "contains no fault, so it gives no case");
  throw Error(ErrorCode::usage, where,
              "has no fault " + std::to_string(id) + "; its faults are numbered 1 to " +
                  std::to_string(diagnosis.at("faults").size()));
}

/// A finding of its signals alone (second residuals, tracking) has none: all are missing then.
std::vector<double> features_from(const Json& json, const std::vector<std::string>& names) {
  if (json.empty()) return std::vector<double>(names.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<double> values;
  for (const std::string& name : names) {
    if (!json.contains(name))
      throw Error(ErrorCode::input, "features",
                  "\"" + name + "\", which this case base compares, is not among them");
    values.push_back(number_or_nan(json.at(name)));
  }
  return values;
}

/// Of a log that was given as ../run.csv its own name alone: a case base may be handed on.
std::string origin_from(const std::string& log_path) {
  if (is_plain_log_name(log_path)) return log_path;
  const std::string name = std::filesystem::path(log_path).filename().string();
  return is_plain_log_name(name) ? name : "";
}

Case parsed(const std::string& text, const std::string& where, int fault_id,
            const std::vector<std::string>& names) {
  const Json json = Json::parse(text);
  if (!json.is_object() || json.value("schema", "") != "faultline/diagnosis/1")
    throw Error(ErrorCode::input, "schema", "is not \"faultline/diagnosis/1\"");
  const Json& fault = fault_with_id(json, where, fault_id);
  Case c;
  c.decision = c.label = label_from(fault);
  c.episode.mlp = opinion_from(fault.at("opinions").at("mlp"));
  c.episode.rbfn = opinion_from(fault.at("opinions").at("rbfn"));
  c.episode.evidence = number_or_nan(fault.at("episode").at("evidence"));
  c.episode.features = features_from(fault.at("episode").at("features"), names);
  c.origin = origin_from(json.at("log").at("path").get<std::string>());
  c.robot = text_or_empty(json.at("model").at("name"));
  c.log_sha256 = text_or_empty(json.at("log").at("sha256"));
  c.onset_s = number_or_nan(fault.at("onset_s"));
  return c;
}

}  // namespace

Case case_from_json(const std::string& text, const std::string& where, int fault_id,
                    const std::vector<std::string>& feature_names) try {
  return parsed(text, where, fault_id, feature_names);
} catch (const nlohmann::json::exception&) {
  throw Error(ErrorCode::input, where,
              "is not a JSON report; a case is made from the output of `faultline diagnose --json`");
} catch (const Error& error) {
  if (error.where() == where) throw;
  throw Error(ErrorCode::input, where,
              "cannot become a case: " + std::string(error.what()) +
                  "; a JSON report made with the model of this case base is needed");
}

}  // namespace faultline
