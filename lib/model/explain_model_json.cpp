// SPDX-License-Identifier: MIT
#include "lib/model/explain_model_json.hpp"

#include <nlohmann/json.hpp>

#include "lib/balance/regressor.hpp"
#include "lib/core/error.hpp"
#include "lib/core/json/json_matrix.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Eigen::VectorXi;

/// Visitor that writes each member to `json`.
struct Writer {
  nlohmann::json json = nlohmann::json::object();

  void operator()(const char* key, const double& value) { json[key] = value; }
  void operator()(const char* key, const int& value) { json[key] = value; }
  void operator()(const char* key, const bool& value) { json[key] = value; }
  void operator()(const char* key, const VectorXd& value) { json[key] = vector_to_json(value); }
  void operator()(const char* key, const VectorXi& value) {
    json[key] = std::vector<int>(value.begin(), value.end());
  }
  void operator()(const char* key, const MatrixXd& value) { json[key] = matrix_to_json(value); }
};

/// Visitor that reads each member from `json`.
struct Reader {
  const nlohmann::json& json;
  const std::string& where;

  void operator()(const char* key, double& value) const { value = number_from_json(json, key, where); }
  void operator()(const char* key, int& value) const { value = json.at(key).get<int>(); }
  void operator()(const char* key, bool& value) const { value = json.at(key).get<bool>(); }
  void operator()(const char* key, VectorXd& value) const { value = vector_from_json(json, key, where); }
  void operator()(const char* key, VectorXi& value) const {
    const auto list = json.at(key).get<std::vector<int>>();
    value = Eigen::Map<const VectorXi>(list.data(), static_cast<Eigen::Index>(list.size()));
  }
  void operator()(const char* key, MatrixXd& value) const { value = matrix_from_json(json, key, where); }
};

template <typename Setting, typename Visit>
void visit_rows(Setting& s, Visit& visit) {
  visit("period_s", s.period_s);
  visit("averaged", s.averaged);
  visit("kernel_s", s.kernel_s);
  visit("friction_s", s.friction_s);
  visit("decimation", s.decimation);
  visit("torque_is_held", s.torque_is_held);
  visit("torque_lag", s.torque_lag);
  visit("velocity_is_difference", s.velocity_is_difference);
  visit("fusion", s.fusion);
  visit("friction_width", s.friction_width);
  visit("compliance", s.compliance);
}

template <typename Setting, typename Visit>
void visit_steps(Setting& s, Visit& visit) {
  visit("period_s", s.period_s);
  visit("torque_is_held", s.torque_is_held);
  visit("substep_s", s.substep_s);
}

template <typename Noise, typename Visit>
void visit_noise(Noise& n, Visit& visit) {
  visit("base", n.base);
  visit("torque", n.torque);
  visit("rest", n.rest);
  visit("speed", n.speed);
  visit("timing", n.timing);
  visit("filter", n.filter);
  visit("innovation", n.innovation);
}

template <typename Model, typename Visit>
void visit_common_fields(Model& m, Visit& visit) {
  visit("theta", m.theta);
  visit("day_variance", m.day_variance);
  visit("torque_is_measured", m.torque_is_measured);
  visit("q_low", m.q_low);
  visit("q_high", m.q_high);
  visit("top_speed", m.top_speed);
  visit("torque_rms", m.torque_rms);
  visit("longest_repeat", m.longest_repeat);
  visit("repeat_share", m.repeat_share);
}

template <typename Model, typename Visit>
void visit_balance(Model& m, Visit& visit) {
  visit_common_fields(m, visit);
  visit("payload", m.payload);
  visit("piece_kg", m.piece_kg);
  visit("q_noise", m.q_noise);
  visit("dq_noise", m.dq_noise);
  visit("stiction", m.stiction);
}

template <typename Model, typename Visit>
void visit_one_step(Model& m, Visit& visit) {
  visit_common_fields(m, visit);
  visit("payload", m.payload);
  visit("carried_kg", m.carried_kg);
  visit("reading_variance", m.reading_variance);
}

template <typename Value, typename Visiting>
nlohmann::json written(const Value& value, Visiting visiting) {
  Writer writer;
  visiting(value, writer);
  return std::move(writer.json);
}

template <typename Value, typename Visiting>
void read_value(const nlohmann::json& json, const std::string& where, Value& value, Visiting visiting) {
  const Reader reader{json, where};
  visiting(value, reader);
}

constexpr auto kRows = [](auto& value, auto& visit) { visit_rows(value, visit); };
constexpr auto kSteps = [](auto& value, auto& visit) { visit_steps(value, visit); };
constexpr auto kNoise = [](auto& value, auto& visit) { visit_noise(value, visit); };
constexpr auto kBalance = [](auto& value, auto& visit) { visit_balance(value, visit); };
constexpr auto kOneStep = [](auto& value, auto& visit) { visit_one_step(value, visit); };

[[noreturn]] void refuse_damaged(const std::string& where, const std::string& what) {
  throw Error(ErrorCode::input, where, "is a damaged model (" + what + "); learn it again");
}

nlohmann::json rigid_to_json(const RigidColumns& rigid) {
  nlohmann::json joints = nlohmann::json::array();
  for (const JointGeometry& joint : rigid.chain.geometry)
    joints.push_back({{"slides", joint.kind == AxisKind::prismatic},
                      {"axis", vector_to_json(joint.axis)},
                      {"offset", vector_to_json(joint.offset)},
                      {"direction", vector_to_json(joint.direction)}});
  return {{"joints", joints},
          {"length", rigid.chain.length},
          {"rotor_inertia", rigid.chain.rotor_inertia},
          {"gravity", vector_to_json(rigid.chain.gravity)},
          {"lift", matrix_to_json(rigid.lift)}};
}

Eigen::Vector3d place_from_json(const nlohmann::json& json, const char* key, const std::string& where) {
  const VectorXd place = vector_from_json(json, key, where);
  if (place.size() != 3)
    refuse_damaged(where, std::string("\"") + key + "\" of a joint is not a vector of 3 numbers");
  return place;
}

RigidColumns rigid_from_json(const nlohmann::json& json, const std::string& where) {
  RigidColumns rigid;
  for (const nlohmann::json& joint : json.at("joints"))
    rigid.chain.geometry.push_back({joint.at("slides").get<bool>() ? AxisKind::prismatic : AxisKind::revolute,
                                    place_from_json(joint, "axis", where),
                                    place_from_json(joint, "offset", where),
                                    place_from_json(joint, "direction", where)});
  const auto n = rigid.chain.geometry.size();
  rigid.chain.length = json.at("length").get<std::vector<double>>();
  rigid.chain.rotor_inertia = json.at("rotor_inertia").get<std::vector<double>>();
  rigid.chain.gravity = place_from_json(json, "gravity", where);
  rigid.chain.links.resize(n);
  rigid.chain.friction.resize(n);
  rigid.lift = matrix_from_json(json, "lift", where);
  if (n == 0 || n > kMaxJoints || rigid.chain.length.size() > n || rigid.chain.rotor_inertia.size() > n ||
      rigid.lift.rows() != static_cast<Eigen::Index>(n * (kLinkParameters + 1)))
    refuse_damaged(where, "the parts of its robot are inconsistent");
  return rigid;
}

void check_sizes(const std::string& where, Eigen::Index size, std::initializer_list<Eigen::Index> all) {
  for (const Eigen::Index other : all)
    if (other != size) refuse_damaged(where, "its lists differ in their numbers of joints");
}

nlohmann::json balance_to_json(const BalanceModel& m) {
  nlohmann::json json = written(m, kBalance);
  json["setting"] = written(m.setting, kRows);
  json["rigid"] = rigid_to_json(m.rigid);
  json["ripples"] = nlohmann::json::array();
  for (const RippleRate& ripple : m.setting.ripples)
    json["ripples"].push_back({{"joint", ripple.joint + 1}, {"rate", ripple.rate}});
  json["noise"] = nlohmann::json::array();
  for (const JointNoise& noise : m.noise.joint) json["noise"].push_back(written(noise, kNoise));
  return json;
}

BalanceModel balance_from_json(const nlohmann::json& json, const std::string& where) {
  BalanceModel m;
  read_value(json, where, m, kBalance);
  read_value(json.at("setting"), where, m.setting, kRows);
  m.rigid = rigid_from_json(json.at("rigid"), where);
  for (const nlohmann::json& ripple : json.at("ripples"))
    m.setting.ripples.push_back({ripple.at("joint").get<int>() - 1, ripple.at("rate").get<double>()});
  for (const nlohmann::json& noise : json.at("noise"))
    read_value(noise, where, m.noise.joint.emplace_back(), kNoise);
  const Eigen::Index n = m.rigid.joints();
  check_sizes(where, n,
              {m.setting.friction_width.size(), m.setting.compliance.size(), std::ssize(m.noise.joint),
               m.q_noise.size(), m.q_low.size(), m.q_high.size(), m.top_speed.size(), m.torque_rms.size(),
               m.longest_repeat.size(), m.repeat_share.size(), m.payload.cols(), m.stiction.size()});
  if (m.setting.fusion.size() > 0) check_sizes(where, n, {m.setting.fusion.size()});
  check_sizes(where, m.layout().count(), {m.theta.size()});
  check_sizes(where, day_layout(m.rigid).count(), {m.day_variance.size()});
  check_sizes(where, m.rigid.base(), {m.payload.rows()});
  for (const RippleRate& ripple : m.setting.ripples)
    if (ripple.joint < 0 || ripple.joint >= n) refuse_damaged(where, "a ripple has no valid joint");
  if (m.setting.decimation < 1) refuse_damaged(where, "its rows lie less than a sample apart");
  return m;
}

nlohmann::json one_step_to_json(const OneStepModel& m) {
  nlohmann::json json = written(m, kOneStep);
  json["setting"] = written(m.setting, kSteps);
  json["rigid"] = rigid_to_json(m.body.rigid());
  json["friction_width"] = vector_to_json(m.body.friction_width());
  return json;
}

OneStepModel one_step_from_json(const nlohmann::json& json, const std::string& where) {
  OneStepModel m;
  read_value(json, where, m, kOneStep);
  read_value(json.at("setting"), where, m.setting, kSteps);
  m.body =
      MotionBody(rigid_from_json(json.at("rigid"), where), vector_from_json(json, "friction_width", where));
  const Eigen::Index n = m.joints();
  check_sizes(where, n,
              {m.body.friction_width().size(), m.q_low.size(), m.q_high.size(), m.top_speed.size(),
               m.torque_rms.size(), m.longest_repeat.size(), m.repeat_share.size()});
  check_sizes(where, 2 * n, {m.reading_variance.size()});
  check_sizes(where, m.layout().learned(), {m.theta.size()});
  check_sizes(where, m.day_layout().count(), {m.day_variance.size()});
  check_sizes(where, n, {m.payload.cols(), m.carried_kg.size()});
  check_sizes(where, m.layout().base, {m.payload.rows()});
  return m;
}

}  // namespace

nlohmann::json explain_model_to_json(const ExplainModel& model) {
  nlohmann::json json = {{"limits", nlohmann::json::object()}, {"window_s", model.window_s}};
  for (int k = 0; k < kFaultKinds; ++k)
    json["limits"][to_string(static_cast<FaultKind>(k))] = model.limits.nats[static_cast<std::size_t>(k)];
  if (const auto* coarse = std::get_if<OneStepModel>(&model.robot))
    json["one_step"] = one_step_to_json(*coarse);
  else
    json["balance"] = balance_to_json(std::get<BalanceModel>(model.robot));
  return json;
}

ExplainModel explain_model_from_json(const nlohmann::json& json, const std::string& where) {
  ExplainModel model;
  for (int k = 0; k < kFaultKinds; ++k)
    model.limits.nats[static_cast<std::size_t>(k)] =
        number_from_json(json.at("limits"), to_string(static_cast<FaultKind>(k)), where);
  model.window_s = number_from_json(json, "window_s", where);
  if (json.contains("one_step"))
    model.robot = one_step_from_json(json.at("one_step"), where);
  else
    model.robot = balance_from_json(json.at("balance"), where);
  return model;
}

}  // namespace faultline
