// SPDX-License-Identifier: MIT
#include "lib/model/model.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/json/json_fields.hpp"
#include "lib/core/json/json_matrix.hpp"
#include "lib/core/json_values.hpp"
#include "lib/fault/label_fields.hpp"
#include "lib/identify/identification_json.hpp"
#include "lib/model/model_text.hpp"
#include "lib/model/twin/twin_options.hpp"
#include "lib/residual/relation/signal_relation.hpp"
#include "lib/robot/payload.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

constexpr std::size_t kLargestModel = 64 << 20;           // bytes
constexpr const char* kLearnedFromTracking = "tracking";  // learned from logs without torque: no mechanics

nlohmann::json json_of_classifier(const SampleClassifier& classifier) { return classifier; }

}  // namespace

void fields(auto& v, MaybeConst<ValidationRow> auto& row) {
  v.named("kind", row.kind, fault_kind_from);
  v("runs", row.runs);
  v("detected", row.detected);
  v("right_kind", row.right_kind);
  v("right_joint", row.right_joint);
  v("right_kind_and_joint", row.right_kind_and_joint);
  v("right_or_named", row.right_or_named);
  v("median_delay_s", row.median_delay_s);
  v("p90_delay_s", row.p90_delay_s);
}

void fields(auto& v, MaybeConst<Detectability> auto& each) {
  fields(v, each.label);
  v("runs", each.runs);
  v("found", each.found);
  v("size", each.size);
  v("least_size", each.least_size);
  v("median_delay_s", each.median_delay_s);
}

void fields(auto& v, MaybeConst<Validation> auto& validation) {
  v("rows", validation.rows);
  v("reach", validation.reach);
  v("early_alarms", validation.early_alarms);
  v.finite("healthy_hours", validation.healthy_hours);
  v("false_alarms", validation.false_alarms);
  v("raw_confidence_error", validation.raw_confidence_error);
  v("confidence_error", validation.confidence_error);
}

void fields(auto& v, MaybeConst<ModelSource> auto& source) {
  v("path", source.path);
  v("sha256", source.sha256);
  v("rows", source.rows);
  v("fault", source.fault);
}

void fields(auto& v, MaybeConst<ModelEdit> auto& edit) {
  v("digest_before", edit.digest_before);
  v("why", edit.why);
}

void fields(auto& v, MaybeConst<CriterionOptions> auto& options) {
  v("g", options.g);
  v.finite("threshold", options.threshold);
  v.finite("sample_cap", options.sample_cap);
}

void fields(auto& v, MaybeConst<SampleMode> auto& samples) {
  v.as("classifier", samples.classifier, json_of_classifier, sample_classifier_from_json);
  v("consecutive", samples.consecutive);
  v("log_odds", samples.log_odds);
}

void fields(auto& v, MaybeConst<ConfidenceCalibration> auto& calibration) {
  v.finite("slope", calibration.slope);
  v.finite("shift", calibration.shift);
  v.finite("most", calibration.most);
}

namespace {

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
  for (int j = 0; j < std::ssize(usual.q_low); ++j)
    if (!(usual.q_low[j] <= usual.q_high[j]))
      throw Error(
          ErrorCode::input, where,
          fmt::format("\"q_low\" of joint {} is above its \"q_high\"; learn the model again", Joint::at(j)));
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

Model read_members(const nlohmann::json& json, const std::string& where) {
  Model model;
  model.name = json.at("name").get<std::string>();
  model.robot = robot_from_toml(json.at("robot").get<std::string>(), where + ", robot");
  check_robot_ranges(model.robot, where);
  FieldReader<nlohmann::json> reader(json, where);
  reader("identity", model.identity);
  reader.unless_empty("doubts", model.doubts);
  reader.unless_empty("grave_doubts", model.grave_doubts);
  reader.unless_empty("edited", model.edits);
  reader.finite("sample_period_s", model.sample_period_s);
  reader("has_velocity", model.has_velocity);
  reader("sources", model.sources);
  if (json.contains("relations"))
    model.relations = relations_from_json(json["relations"], model.robot.joints(), where);
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
  reader("confidence", model.confidence);
  reader("samples", model.samples);
  reader("validation", model.validation);
  model.twin = twin_from_json(nlohmann::ordered_json(json.at("twin")), where);
  return model;
}

void add_mechanics(const Model& model, nlohmann::ordered_json& json) {
  json["twin"] = twin_to_json(model.twin);
  json["validation"] = fields_to_json<nlohmann::json>(model.validation);
  json["explain"] = explain_model_to_json(model.explain);
  json["motion"] = usual_motion_to_json(model.motion);
  json["residual"] = nlohmann::json(model.residual);
  json["judges"] = nlohmann::json(model.episode_classifier);
  json["confidence"] = fields_to_json<nlohmann::json>(model.confidence);
  json["samples"] = fields_to_json<nlohmann::json>(model.samples);
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
  json["sources"] = fields_to_json<nlohmann::json>(model.sources);
  if (model.has_mechanics()) add_mechanics(model, json);
  if (!model.relations.empty()) json["relations"] = relations_to_json(model.relations);
  if (!model.edits.empty()) json["edited"] = fields_to_json<nlohmann::json>(model.edits);
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
