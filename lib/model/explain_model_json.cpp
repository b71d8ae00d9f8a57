// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "lib/balance/regressor.hpp"
#include "lib/core/error.hpp"
#include "lib/core/json/json_fields.hpp"
#include "lib/model/model_text.hpp"

namespace faultline {
namespace {

[[noreturn]] void refuse_damaged(const std::string& where, const std::string& what) {
  throw Error(ErrorCode::input, where, "is a damaged model (" + what + "); learn it again");
}

bool slides(AxisKind kind) { return kind == AxisKind::prismatic; }
AxisKind axis_kind_from(bool slides) { return slides ? AxisKind::prismatic : AxisKind::revolute; }

Eigen::VectorXd numbers_of(const Eigen::Vector3d& place) { return place; }
Eigen::Vector3d place_from(const Eigen::VectorXd& place, const std::string& where) {
  if (place.size() != 3) refuse_damaged(where, "a place or direction of its robot does not have 3 numbers");
  return place;
}

/// What both models of a robot have.
void common_fields(auto& v, auto& m) {
  v("theta", m.theta);
  v("day_variance", m.day_variance);
  v("torque_is_measured", m.torque_is_measured);
  v("q_low", m.q_low);
  v("q_high", m.q_high);
  v("top_speed", m.top_speed);
  v("torque_rms", m.torque_rms);
  v("longest_repeat", m.longest_repeat);
  v("repeat_share", m.repeat_share);
  v("payload", m.payload);
  v("setting", m.setting);
}

}  // namespace

void fields(auto& v, MaybeConst<JointGeometry> auto& joint) {
  v.as("slides", joint.kind, slides, axis_kind_from);
  v.as("axis", joint.axis, numbers_of, place_from);
  v.as("offset", joint.offset, numbers_of, place_from);
  v.as("direction", joint.direction, numbers_of, place_from);
}

void fields(auto& v, MaybeConst<RigidColumns> auto& rigid) {
  v("joints", rigid.chain.geometry);
  v("length", rigid.chain.length);
  v("rotor_inertia", rigid.chain.rotor_inertia);
  v.as("gravity", rigid.chain.gravity, numbers_of, place_from);
  v("lift", rigid.lift);
}

void fields(auto& v, MaybeConst<CoupledDrive> auto& drive) {
  v("along", drive.along);
  v("friction_width", drive.friction_width);
}

void fields(auto& v, MaybeConst<RowSetting> auto& s) {
  v("period_s", s.period_s);
  v("averaged", s.averaged);
  v("kernel_s", s.kernel_s);
  v("friction_s", s.friction_s);
  v("decimation", s.decimation);
  v("torque_is_held", s.torque_is_held);
  v("torque_lag", s.torque_lag);
  v("fusion", s.fusion);
  v("friction_width", s.friction_width);
  v("compliance", s.compliance);
  v("drives", s.drives);
}

void fields(auto& v, MaybeConst<StepSetting> auto& s) {
  v("period_s", s.period_s);
  v("torque_is_held", s.torque_is_held);
  v("substep_s", s.substep_s);
}

void fields(auto& v, MaybeConst<RippleRate> auto& ripple) {
  v("joint", ripple.joint);
  v("rate", ripple.rate);
}

void fields(auto& v, MaybeConst<JointNoise> auto& n) {
  v("base", n.base);
  v("torque", n.torque);
  v("rest", n.rest);
  v("speed", n.speed);
  v("timing", n.timing);
  v("others", n.others);
  v("filter", n.filter);
  v("innovation", n.innovation);
}

void fields(auto& v, MaybeConst<BalanceModel> auto& m) {
  common_fields(v, m);
  v("piece_kg", m.piece_kg);
  v("q_noise", m.q_noise);
  v("dq_noise", m.dq_noise);
  v("stiction", m.stiction);
  v("drive_limit", m.drive_limit);
  v("rigid", m.rigid);
  v("ripples", m.setting.ripples);
  v("noise", m.noise.joint);
}

/// All but the body.
void fields(auto& v, MaybeConst<OneStepModel> auto& m) {
  common_fields(v, m);
  v("carried_kg", m.carried_kg);
  v("reading_variance", m.reading_variance);
}

/// All but the model of the robot.
void fields(auto& v, MaybeConst<ExplainModel> auto& model) {
  v.object("limits", [&](auto& limits) {
    for (int k = 0; k < kFaultKinds; ++k)
      limits(to_string(static_cast<FaultKind>(k)), model.limits.nats[static_cast<std::size_t>(k)]);
  });
  v("window_s", model.window_s);
}

namespace {

/// Gives the chain the links that it needs beside its geometry, and checks that all parts fit together.
void complete(RigidColumns& rigid, const std::string& where) {
  const auto n = rigid.chain.geometry.size();
  rigid.chain.links.resize(n);
  rigid.chain.friction.resize(n);
  if (n == 0 || n > kMaxJoints || rigid.chain.length.size() > n || rigid.chain.rotor_inertia.size() > n ||
      rigid.lift.rows() != static_cast<Eigen::Index>(n * (kLinkParameters + 1)))
    refuse_damaged(where, "the parts of its robot are inconsistent");
}

void check_sizes(const std::string& where, Eigen::Index size, std::initializer_list<Eigen::Index> all) {
  for (const Eigen::Index other : all)
    if (other != size) refuse_damaged(where, "its lists differ in their numbers of joints");
}

BalanceModel balance_from_json(const nlohmann::json& json, const std::string& where) {
  auto m = fields_from_json<BalanceModel, true>(json, where);
  complete(m.rigid, where);
  const Eigen::Index n = m.rigid.joints();
  check_sizes(where, n,
              {m.setting.friction_width.size(), m.setting.compliance.size(), std::ssize(m.noise.joint),
               m.q_noise.size(), m.q_low.size(), m.q_high.size(), m.top_speed.size(), m.torque_rms.size(),
               m.longest_repeat.size(), m.repeat_share.size(), m.payload.cols(), m.stiction.size(),
               m.drive_limit.size()});
  if (m.setting.fusion.size() > 0) check_sizes(where, n, {m.setting.fusion.size()});
  check_sizes(where, m.layout().count(), {m.theta.size()});
  check_sizes(where, day_layout(m).count(), {m.day_variance.size()});
  check_sizes(where, m.rigid.base(), {m.payload.rows()});
  for (const CoupledDrive& drive : m.setting.drives) check_sizes(where, n, {drive.along.size()});
  for (const RippleRate& ripple : m.setting.ripples)
    if (ripple.joint.is_none() || ripple.joint.index() >= n)
      refuse_damaged(where, "a ripple has no valid joint");
  if (m.setting.decimation < 1) refuse_damaged(where, "its rows lie less than a sample apart");
  return m;
}

nlohmann::json one_step_to_json(const OneStepModel& m) {
  FieldWriter<nlohmann::json> writer;
  fields(writer, m);
  writer("rigid", m.body.rigid());
  writer("friction_width", m.body.friction_width());
  return writer.json();
}

OneStepModel one_step_from_json(const nlohmann::json& json, const std::string& where) {
  auto m = fields_from_json<OneStepModel, true>(json, where);
  auto rigid = fields_from_json<RigidColumns, true>(json.at("rigid"), where);
  complete(rigid, where);
  m.body = MotionBody(std::move(rigid), vector_from_json(json, "friction_width", where));
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
  auto json = fields_to_json<nlohmann::json>(model);
  if (const auto* coarse = std::get_if<OneStepModel>(&model.robot))
    json["one_step"] = one_step_to_json(*coarse);
  else
    json["balance"] = fields_to_json<nlohmann::json>(std::get<BalanceModel>(model.robot));
  return json;
}

ExplainModel explain_model_from_json(const nlohmann::json& json, const std::string& where) {
  auto model = fields_from_json<ExplainModel, true>(json, where);
  if (json.contains("one_step"))
    model.robot = one_step_from_json(json.at("one_step"), where);
  else
    model.robot = balance_from_json(json.at("balance"), where);
  return model;
}

}  // namespace faultline
