// SPDX-License-Identifier: MIT
#include "lib/model/model.hpp"

#include <nlohmann/json.hpp>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/json/json_depth.hpp"
#include "lib/core/json/json_matrix.hpp"
#include "lib/core/json_values.hpp"
#include "lib/identify/identification_json.hpp"
#include "lib/model/explain_model_json.hpp"
#include "lib/model/model_ranges.hpp"
#include "lib/model/model_text.hpp"
#include "lib/model/twin/twin_json.hpp"
#include "lib/residual/relation/relation_json.hpp"
#include "lib/robot/payload.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

constexpr std::size_t kLargestModel = 64 << 20;           // bytes
constexpr const char* kLearnedFromTracking = "tracking";  // learned from logs without torque: no mechanics

nlohmann::json validation_to_json(const Validation& validation) {
  nlohmann::json rows = nlohmann::json::array();
  for (const ValidationRow& row : validation.rows)
    rows.push_back({{"kind", to_string(row.kind)},
                    {"runs", row.runs},
                    {"detected", row.detected},
                    {"right_kind", row.right_kind},
                    {"right_joint", row.right_joint},
                    {"right_kind_and_joint", row.right_kind_and_joint},
                    {"right_or_named", row.right_or_named},
                    {"median_delay_s", number_or_null(row.median_delay_s)},
                    {"p90_delay_s", number_or_null(row.p90_delay_s)}});
  nlohmann::json reach = nlohmann::json::array();
  for (const Detectability& each : validation.reach)
    reach.push_back({{"kind", to_string(each.label.kind)},
                     {"joint", each.label.joint},
                     {"runs", each.runs},
                     {"found", each.found},
                     {"size", number_or_null(each.size)},
                     {"least_size", number_or_null(each.least_size)},
                     {"median_delay_s", number_or_null(each.median_delay_s)}});
  return {{"rows", rows},
          {"reach", reach},
          {"early_alarms", validation.early_alarms},
          {"healthy_hours", validation.healthy_hours},
          {"false_alarms", validation.false_alarms},
          {"raw_confidence_error", number_or_null(validation.raw_confidence_error)},
          {"confidence_error", number_or_null(validation.confidence_error)}};
}

/// Throws the exceptions of nlohmann::json, and Error(usage) for an unknown kind.
Validation validation_from_json(const nlohmann::json& json) {
  Validation validation;
  for (const auto& row : json.at("rows"))
    validation.rows.push_back({fault_kind_from(row.at("kind")), row.at("runs"), row.at("detected"),
                               row.at("right_kind"), row.at("right_joint"), row.at("right_kind_and_joint"),
                               row.at("right_or_named"), number_or_nan(row.at("median_delay_s")),
                               number_or_nan(row.at("p90_delay_s"))});
  for (const auto& each : json.at("reach"))
    validation.reach.push_back({{fault_kind_from(each.at("kind")), each.at("joint")},
                                each.at("runs"),
                                each.at("found"),
                                number_or_nan(each.at("size")),
                                number_or_nan(each.at("least_size")),
                                number_or_nan(each.at("median_delay_s"))});
  validation.early_alarms = json.at("early_alarms");
  validation.healthy_hours = json.at("healthy_hours");
  validation.false_alarms = json.at("false_alarms");
  validation.raw_confidence_error = number_or_nan(json.at("raw_confidence_error"));
  validation.confidence_error = number_or_nan(json.at("confidence_error"));
  return validation;
}

/// Calls visit(key, vector) for every list with one number for each joint.
template <typename Usual, typename Visit>
void visit_joint_lists(Usual& usual, Visit visit) {
  visit("q_low", usual.q_low);
  visit("q_high", usual.q_high);
  visit("velocity_scale", usual.velocity_scale);
  visit("torque_scale", usual.torque_scale);
  visit("usual_bias", usual.sizes.bias);
  visit("usual_drift", usual.sizes.drift);
  visit("usual_viscous_increase", usual.sizes.viscous_increase);
  visit("usual_coulomb_increase", usual.sizes.coulomb_increase);
  visit("usual_external_torque", usual.sizes.external_torque);
}

void check_ranges(const UsualMotion& usual, const std::string& where) {
  for (std::size_t j = 0; j < usual.q_low.size(); ++j)
    if (!(usual.q_low[j] <= usual.q_high[j]))
      throw Error(
          ErrorCode::input, where,
          "\"q_low\" of joint " + std::to_string(j + 1) + " is above its \"q_high\"; learn the model again");
}

nlohmann::json usual_motion_to_json(const UsualMotion& usual) {
  nlohmann::json json = nlohmann::json::object();
  visit_joint_lists(usual, [&](const char* key, const auto& values) { json[key] = values; });
  json["usual_payload"] = usual.sizes.payload;
  return json;
}

/// Throws Error(input) if a key is missing or a list does not have one number for each of `joints`.
UsualMotion usual_motion_from_json(const nlohmann::json& json, int joints, const std::string& where) {
  UsualMotion usual;
  visit_joint_lists(usual, [&](const char* key, std::vector<double>& values) {
    const Eigen::VectorXd read = vector_from_json(json, key, where);
    if (read.size() != joints)
      throw Error(ErrorCode::input, where,
                  std::string("\"") + key + "\" has " + std::to_string(read.size()) +
                      " numbers, expected one a joint (" + std::to_string(joints) +
                      "); learn the model again");
    values.assign(read.begin(), read.end());
  });
  check_ranges(usual, where);
  usual.sizes.payload = number_from_json(json, "usual_payload", where);
  return usual;
}

nlohmann::json sources_to_json(const std::vector<ModelSource>& sources) {
  nlohmann::json list = nlohmann::json::array();
  for (const ModelSource& source : sources)
    list.push_back(
        {{"path", source.path}, {"sha256", source.sha256}, {"rows", source.rows}, {"fault", source.fault}});
  return list;
}

nlohmann::json criterion_to_json(const CriterionOptions& options) {
  return {{"g", options.g}, {"threshold", options.threshold}, {"sample_cap", options.sample_cap}};
}

CriterionOptions criterion_from_json(CriterionKind kind, const nlohmann::json& json) {
  return {kind, json.at("g").get<int>(), json.at("threshold").get<double>(),
          json.at("sample_cap").get<double>()};
}

nlohmann::json samples_to_json(const SampleMode& samples) {
  nlohmann::json classifier;
  to_json(classifier, samples.classifier);
  return {{"classifier", classifier},
          {"consecutive", criterion_to_json(samples.consecutive)},
          {"log_odds", criterion_to_json(samples.log_odds)}};
}

SampleMode samples_from_json(const nlohmann::json& json, const std::string& where) {
  return {sample_classifier_from_json(json.at("classifier"), where),
          criterion_from_json(CriterionKind::consecutive, json.at("consecutive")),
          criterion_from_json(CriterionKind::log_odds, json.at("log_odds"))};
}

nlohmann::json calibration_to_json(const ConfidenceCalibration& calibration) {
  return {{"slope", calibration.slope}, {"shift", calibration.shift}, {"most", calibration.most}};
}

ConfidenceCalibration calibration_from_json(const nlohmann::json& json) {
  return {json.at("slope").get<double>(), json.at("shift").get<std::array<double, kConfidenceSources>>(),
          json.at("most").get<double>()};
}

/// Reads the identity of the model, its edits and its doubts.
void read_origin(const nlohmann::json& json, Model& model) {
  model.identity = json.at("identity").get<std::string>();
  model.doubts = json.value("doubts", std::vector<std::string>{});
  model.grave_doubts = json.value("grave_doubts", std::vector<std::string>{});
  if (json.contains("edited"))
    for (const auto& edit : json["edited"])
      model.edits.push_back({edit.at("digest_before").get<std::string>(), edit.at("why").get<std::string>()});
}

Model read_members(const nlohmann::json& json, const std::string& where) {
  Model model;
  model.name = json.at("name").get<std::string>();
  model.robot = robot_from_toml(json.at("robot").get<std::string>(), where + ", robot");
  check_robot_ranges(model.robot, where);
  read_origin(json, model);
  model.sample_period_s = json.at("sample_period_s");
  model.has_velocity = json.at("has_velocity");
  if (json.contains("relations"))
    model.relations = relations_from_json(json["relations"], model.robot.joints(), where);
  for (const auto& source : json.at("sources"))
    model.sources.push_back({source.at("path"), source.at("sha256"), source.at("rows"), source.at("fault")});
  if (json.contains("learned_from") && json["learned_from"] == kLearnedFromTracking) {
    if (model.relations.empty())
      throw Error(ErrorCode::input, where,
                  "is a damaged model (it has no relations to judge a log by); learn it again");
    return model;
  }
  model.identification = summary_from_json(nlohmann::ordered_json(json.at("identification")), where);
  model.motion = usual_motion_from_json(json.at("motion"), model.robot.joints(), where);
  model.explain = explain_model_from_json(json.at("explain"), where);
  model.labels = labels_of(model.robot);
  model.residual = residual_generator_from_json(json.at("residual"), model.robot.chain, where);
  model.episode_classifier = episode_classifier_from_json(json.at("judges"), where);
  model.confidence = calibration_from_json(json.at("confidence"));
  model.samples = samples_from_json(json.at("samples"), where);
  model.validation = validation_from_json(json.at("validation"));
  model.twin = twin_from_json(nlohmann::ordered_json(json.at("twin")), where);
  return model;
}

void add_mechanics(const Model& model, nlohmann::ordered_json& json) {
  nlohmann::json residual, judges;
  to_json(residual, model.residual);
  to_json(judges, model.episode_classifier);
  json["twin"] = twin_to_json(model.twin);
  json["validation"] = validation_to_json(model.validation);
  json["explain"] = explain_model_to_json(model.explain);
  json["motion"] = usual_motion_to_json(model.motion);
  json["residual"] = residual;
  json["judges"] = judges;
  json["confidence"] = calibration_to_json(model.confidence);
  json["samples"] = samples_to_json(model.samples);
}

}  // namespace

std::string model_to_json(const Model& model) {
  nlohmann::ordered_json json;
  json["schema"] = model_schema(kModelVersion);
  json["name"] = model.name;
  if (!model.identity.empty()) json["identity"] = model.identity;  // bind_cases() hashes the text without
  if (!model.has_mechanics()) json["learned_from"] = kLearnedFromTracking;
  json["robot"] = robot_file_text(model.robot);
  if (model.has_mechanics()) json["identification"] = summary_to_json(model.identification);
  if (!model.doubts.empty()) json["doubts"] = model.doubts;
  if (!model.grave_doubts.empty()) json["grave_doubts"] = model.grave_doubts;
  json["sample_period_s"] = model.sample_period_s;
  json["has_velocity"] = model.has_velocity;
  json["sources"] = sources_to_json(model.sources);
  if (model.has_mechanics()) add_mechanics(model, json);
  if (!model.relations.empty()) json["relations"] = relations_to_json(model.relations);
  for (const ModelEdit& edit : model.edits)
    json["edited"].push_back({{"digest_before", edit.digest_before}, {"why", edit.why}});
  return sealed_model_text(json);
}

Model model_from_json(const std::string& text, const std::string& where) {
  refuse_deep_json(text, where);
  const nlohmann::json json = read_model_text(text, where);
  check_model_ranges(json, where);
  try {
    Model model = read_members(json, where);
    model.sha256 = sha256_hex(text);
    return model;
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorCode::input, where,
                std::string("is a damaged model (") + error.what() + "); learn it again");
  } catch (const Error& error) {
    if (error.code() != ErrorCode::usage) throw;
    throw Error(ErrorCode::input, where,
                "is a damaged model (" + std::string(error.what()) + "); learn it again");
  }
}

std::vector<FaultLabel> labels_of(const Robot& robot) {
  return fault_labels(robot.joints(), payload_links(robot.chain),
                      robot.log.torque == TorqueMeaning::measured);
}

Model load_model(const std::string& path) { return model_from_json(read_file(path, kLargestModel), path); }

}  // namespace faultline
