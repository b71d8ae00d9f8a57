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

std::vector<SlowState> slow_from_json(const nlohmann::json& json, int joints, const std::string& where) {
  std::vector<SlowState> states;
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

}  // namespace

void to_json(nlohmann::json& json, const MotionModel& model) {
  json = nlohmann::json::object();
  json["slow"] = slow_to_json(model.slow);
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
  return model;
}

}  // namespace faultline
