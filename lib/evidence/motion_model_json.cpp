// SPDX-License-Identifier: MIT
#include "lib/evidence/motion_model_json.hpp"

#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/neural/json_matrix.hpp"

namespace faultline {
namespace {

/// Calls visit(key, vector) for every list that has one number a joint.
template <typename Model, typename Visit>
void visit_joint_lists(Model& model, Visit visit) {
  visit("floor", model.noise.floor);
  visit("q_std", model.q_std);
  visit("dq_std", model.dq_std);
  visit("q_low", model.q_low);
  visit("q_high", model.q_high);
  visit("velocity_scale", model.velocity_scale);
  visit("torque_scale", model.torque_scale);
  visit("inertia_scale", model.inertia_scale);
  visit("repeat_share", model.repeat_share);
  visit("longest_repeat", model.longest_repeat);
  visit("prior_bias", model.priors.bias);
  visit("prior_drift", model.priors.drift);
  visit("prior_viscous_increase", model.priors.viscous_increase);
  visit("prior_coulomb_increase", model.priors.coulomb_increase);
  visit("prior_external_torque", model.priors.external_torque);
}

template <typename Model, typename Visit>
void visit_numbers(Model& model, Visit visit) {
  visit("torque_share", model.noise.torque_share);
  visit("rest_share", model.noise.rest_share);
  visit("step_share", model.noise.step_share);
  visit("correlation_s", model.noise.correlation_s);
  visit("prior_payload", model.priors.payload);
}

template <typename Options, typename Visit>
void visit_options(Options& options, Visit visit) {
  visit("trigger", options.trigger);
  visit("threshold", options.threshold);
  visit("judge_s", options.isolate_s);
  visit("longest_judge_s", options.longest_isolate_s);
  visit("clear_margin", options.clear_margin);
  visit("confirm_s", options.confirm_s);
  visit("recover_s", options.recover_s);
}

nlohmann::json slow_to_json(const std::vector<SlowState>& states) {
  nlohmann::json list = nlohmann::json::array();
  for (const SlowState& slow : states)
    list.push_back({{"state", to_string(slow.kind)},
                    {"joint", slow.joint + 1},
                    {"day_std", slow.day_std},
                    {"walk", slow.walk},
                    {"memory_s", slow.memory_s}});
  return list;
}

/// Models of programs that knew no slow states have none.
std::vector<SlowState> slow_from_json(const nlohmann::json& json, int joints, const std::string& where) {
  std::vector<SlowState> states;
  if (!json.contains("slow")) return states;
  for (const nlohmann::json& entry : json.at("slow")) {
    SlowState slow;
    slow.kind = slow_kind_from(entry.at("state").get<std::string>(), where);
    slow.joint = entry.at("joint").get<int>() - 1;
    slow.day_std = number_from_json(entry, "day_std", where);
    slow.walk = number_from_json(entry, "walk", where);
    slow.memory_s = number_from_json(entry, "memory_s", where);
    if (slow.joint < 0 || slow.joint >= joints || states.size() == kMaxSlowStates)
      throw Error(ErrorCode::input, where,
                  "\"slow\" lists joint " + std::to_string(slow.joint + 1) + " or too many states for " +
                      std::to_string(joints) + " joints; learn the model again");
    states.push_back(slow);
  }
  return states;
}

void check_ranges(const MotionModel& model, const std::string& where) {
  for (std::size_t j = 0; j < model.q_low.size(); ++j)
    if (!(model.q_low[j] <= model.q_high[j]))
      throw Error(ErrorCode::input, where,
                  "\"q_low\" of joint " + std::to_string(j + 1) +
                      " lies above its \"q_high\"; learn the model again");
}

/// What models of earlier programs lack.
void read_later(const nlohmann::json& json, const std::string& where, MotionModel& model) {
  auto read = [&](const char* key, std::vector<double>& values) {
    if (json.contains(key)) values = json.at(key).get<std::vector<double>>();
  };
  read("q_tail", model.q_tail);
  read("compliance", model.noise.compliance);
  read("dq_tail", model.dq_tail);
  read("work_pieces_kg", model.work_pieces_kg);
  read("torque_jump", model.torque_jump);
  if (json.contains("work_piece_doubt"))
    model.work_piece_doubt = number_from_json(json, "work_piece_doubt", where);
}

}  // namespace

void to_json(nlohmann::json& json, const MotionModel& model) {
  json = nlohmann::json::object();
  json["slow"] = slow_to_json(model.slow);
  json["dq_is_difference"] = std::vector<int>(model.dq_is_difference.begin(), model.dq_is_difference.end());
  json["clock_std"] = model.clock_std;
  json["q_tail"] = model.q_tail;
  json["compliance"] = model.noise.compliance;
  json["dq_tail"] = model.dq_tail;
  json["work_pieces_kg"] = model.work_pieces_kg;
  json["work_piece_doubt"] = model.work_piece_doubt;
  json["torque_jump"] = model.torque_jump;
  json["steady_period_s"] = model.steady_period_s;
  json["usual_noise"] = {{"q", model.usual_noise.q}, {"dq", model.usual_noise.dq}};
  json["noise_range"] = model.noise_range;
  visit_joint_lists(model, [&](const char* key, const auto& values) { json[key] = values; });
  visit_numbers(model, [&](const char* key, double value) { json[key] = value; });
}

MotionModel motion_model_from_json(const nlohmann::json& json, const Robot& robot, const std::string& where) {
  MotionModel model;
  model.chain = robot.chain;
  model.torque_phi = robot.torque_phi.value_or(0.0);
  visit_joint_lists(model, [&](const char* key, auto& values) {
    const Eigen::VectorXd read = vector_from_json(json, key, where);
    if (read.size() != robot.joints())
      throw Error(ErrorCode::input, where,
                  std::string("\"") + key + "\" has " + std::to_string(read.size()) +
                      " numbers, expected one a joint (" + std::to_string(robot.joints()) +
                      "); learn the model again");
    for (const double value : read)
      values.push_back(static_cast<typename std::decay_t<decltype(values)>::value_type>(value));
  });
  check_ranges(model, where);
  visit_numbers(model, [&](const char* key, double& value) { value = number_from_json(json, key, where); });
  model.slow = slow_from_json(json, robot.joints(), where);
  model.clock_std = json.contains("clock_std") ? number_from_json(json, "clock_std", where) : 0.0;
  read_later(json, where, model);
  if (json.contains("dq_is_difference"))
    for (const int flag : json.at("dq_is_difference").get<std::vector<int>>())
      model.dq_is_difference.push_back(flag != 0 ? 1 : 0);
  if (json.contains("steady_period_s"))
    model.steady_period_s = number_from_json(json, "steady_period_s", where);
  if (json.contains("usual_noise")) {
    const nlohmann::json& usual = json.at("usual_noise");
    model.usual_noise = {usual.at("q").get<std::vector<double>>(), usual.at("dq").get<std::vector<double>>()};
    model.noise_range = json.at("noise_range").get<std::array<double, 2>>();
  }
  return model;
}

void to_json(nlohmann::json& json, const EvidenceOptions& options) {
  json = nlohmann::json{{"fewest_samples", options.fewest_samples}};
  visit_options(options, [&](const char* key, double value) { json[key] = value; });
  if (options.imitations.empty()) return;
  for (const Imitation& imitation : options.imitations)
    json["imitations"].push_back({{"kind", to_string(imitation.label.kind)},
                                  {"joint", imitation.label.joint},
                                  {"nats", imitation.nats}});
}

EvidenceOptions evidence_options_from_json(const nlohmann::json& json, const std::string& where) {
  EvidenceOptions options;
  options.fewest_samples = static_cast<int>(number_from_json(json, "fewest_samples", where));
  visit_options(options, [&](const char* key, double& value) { value = number_from_json(json, key, where); });
  if (!json.contains("imitations")) return options;
  for (const nlohmann::json& entry : json.at("imitations"))
    options.imitations.push_back(
        {{fault_kind_from(entry.at("kind").get<std::string>()), entry.at("joint").get<int>()},
         number_from_json(entry, "nats", where)});
  return options;
}

}  // namespace faultline
