// SPDX-License-Identifier: MIT
#include "lib/residual/residual_generator.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/enum_named.hpp"
#include "lib/core/error.hpp"
#include "lib/core/json/json_matrix.hpp"
#include "lib/residual/physics_step.hpp"

namespace faultline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

using nlohmann::json;

ResidualKind kind_from(const std::string& name, const std::string& where) {
  if (const auto kind = enum_named(name, {ResidualKind::mlp, ResidualKind::physics, ResidualKind::hybrid}))
    return *kind;
  throw Error(ErrorCode::input, where, "kind: '" + name + "' is none of mlp, physics, hybrid");
}

json shape_to_json(const TransitionShape& shape) {
  return {{"joints", shape.joints},         {"step", shape.step},
          {"stride", shape.stride},         {"step_s", shape.step_s},
          {"torque_phi", shape.torque_phi}, {"derive_velocity", shape.derive_velocity}};
}

TransitionShape shape_from_json(const json& in, const std::string& where) {
  TransitionShape shape;
  shape.joints = count_from_json(in, "joints", where);
  shape.step = count_from_json(in, "step", where);
  shape.stride = count_from_json(in, "stride", where);
  shape.step_s = number_from_json(in, "step_s", where);
  shape.torque_phi = number_from_json(in, "torque_phi", where);
  shape.derive_velocity = flag_from_json(in, "derive_velocity", where);
  if (shape.stride > shape.step || !(shape.step_s > 0.0))
    throw Error(ErrorCode::input, where, "shape: stride must not exceed step, and step_s must be positive");
  return shape;
}

json healthy_to_json(const HealthyResiduals& healthy) {
  return {{"patterns", healthy.patterns},
          {"position_rms", vector_to_json(healthy.position_rms)},
          {"velocity_rms", vector_to_json(healthy.velocity_rms)},
          {"torque_rms", vector_to_json(healthy.torque_rms)},
          {"position_max", vector_to_json(healthy.position_max)},
          {"velocity_max", vector_to_json(healthy.velocity_max)},
          {"torque_max", vector_to_json(healthy.torque_max)}};
}

HealthyResiduals healthy_from_json(const json& in, int joints, const std::string& where) {
  HealthyResiduals healthy;
  healthy.patterns = count_from_json(in, "patterns", where);
  const auto read = [&](const char* key, bool divisor) {
    Eigen::VectorXd values = vector_from_json(in, key, where);
    if (values.size() != joints || (divisor && !(values.array() > 0.0).all()))
      throw Error(ErrorCode::input, where, fmt::format("{}: expected {} positive numbers", key, joints));
    return values;
  };
  healthy.position_rms = read("position_rms", true);
  healthy.velocity_rms = read("velocity_rms", true);
  healthy.torque_rms = read("torque_rms", true);
  healthy.position_max = read("position_max", false);
  healthy.velocity_max = read("velocity_max", false);
  healthy.torque_max = read("torque_max", false);
  return healthy;
}

void check_network(const ResidualGenerator& generator, const std::string& where) {
  const Transitions none = [&] {
    Transitions empty;
    for (auto* matrix : {&empty.q, &empty.dq, &empty.tau, &empty.mean_tau})
      matrix->resize(generator.joints(), 0);
    return empty;
  }();
  const auto inputs = network_inputs(generator, none).rows();
  const int outputs = 2 * generator.joints();
  if (generator.mlp.inputs() != inputs || generator.mlp.outputs() != outputs ||
      generator.inputs.size() != inputs || generator.outputs.size() != outputs)
    throw Error(
        ErrorCode::input, where,
        fmt::format("the network has {} inputs and {} outputs, expected {} and {} for {} joints",
                    generator.mlp.inputs(), generator.mlp.outputs(), inputs, outputs, generator.joints()));
}

}  // namespace

const char* to_string(ResidualKind kind) {
  return kind == ResidualKind::mlp ? "mlp" : kind == ResidualKind::physics ? "physics" : "hybrid";
}

MatrixXd network_inputs(const ResidualGenerator& generator, const Transitions& transitions) {
  const Index n = generator.joints();
  Index turning = 0;
  for (char turns : generator.turns) turning += turns;
  MatrixXd inputs((generator.uses_mean_torque ? 4 : 3) * n + turning, transitions.count());
  inputs.topRows(n) = transitions.q;
  inputs.middleRows(n, n) = transitions.dq;
  inputs.middleRows(2 * n, n) = transitions.tau;
  if (generator.uses_mean_torque) inputs.middleRows(3 * n, n) = transitions.mean_tau;
  Index extra = inputs.rows() - turning;
  for (Index j = 0; j < n; ++j) {
    if (!generator.turns[j]) continue;
    inputs.row(j) = transitions.q.row(j).array().unaryExpr(&elementary::sin);
    inputs.row(extra++) = transitions.q.row(j).array().unaryExpr(&elementary::cos);
  }
  return inputs;
}

MatrixXd network_outputs(const ResidualGenerator& generator, const Transitions& transitions) {
  const MatrixXd inputs = generator.inputs.apply(network_inputs(generator, transitions));
  return generator.outputs.invert(forward(generator.mlp, inputs));
}

MatrixXd base_change(const ResidualGenerator& generator, const Transitions& transitions) {
  const Index n = generator.joints();
  MatrixXd change = MatrixXd::Zero(2 * n, transitions.count());
  if (generator.kind == ResidualKind::mlp) return change;
  const FastDynamics robot(generator.chain);
  for (Index i = 0; i < change.cols(); ++i) {
    const JointState start{transitions.q.col(i), transitions.dq.col(i)};
    const JointState end = physics_step(robot, start, transitions.mean_tau.col(i), transitions.duration[i]);
    change.col(i).head(n) = end.q - start.q;
    change.col(i).tail(n) = end.dq - start.dq;
  }
  return change;
}

MatrixXd predicted_change(const ResidualGenerator& generator, const Transitions& transitions) {
  const Index n = generator.joints();
  MatrixXd change = base_change(generator, transitions);
  if (generator.kind == ResidualKind::physics) return change;
  const MatrixXd outputs = network_outputs(generator, transitions);
  // The network learned the nominal duration; a jittering clock stretches the change. A gap is NaN here.
  const Eigen::RowVectorXd stretch = transitions.duration.transpose() / generator.shape.step_s;
  if (!generator.predicts_state()) return change + (outputs.array().rowwise() * stretch.array()).matrix();
  change.topRows(n) = outputs.topRows(n) - transitions.q;
  change.bottomRows(n) = outputs.bottomRows(n) - transitions.dq;
  change.array().rowwise() *= stretch.array();
  return change;
}

MatrixXd measured_change(const ResidualGenerator& generator, const Transitions& transitions) {
  const Index n = generator.joints();
  MatrixXd change(2 * n, transitions.count());
  change.topRows(n) = transitions.next_q - transitions.q;
  change.bottomRows(n) = transitions.next_dq - transitions.dq;
  for (Index j = 0; j < n; ++j)
    if (generator.turns[j])
      for (double& difference : change.row(j))
        difference = std::remainder(difference, 2.0 * std::numbers::pi);
  return change;
}

void to_json(json& out, const ResidualGenerator& generator) {
  json turns = json::array();
  for (char turning : generator.turns) turns.push_back(turning != 0);
  out = {{"kind", to_string(generator.kind)},
         {"target", generator.target == PredictedQuantity::state ? "state" : "change"},
         {"shape", shape_to_json(generator.shape)},
         {"uses_mean_torque", generator.uses_mean_torque},
         {"turns", std::move(turns)},
         {"healthy", healthy_to_json(generator.healthy)}};
  if (generator.kind == ResidualKind::physics) return;
  out["inputs"] = generator.inputs;
  out["outputs"] = generator.outputs;
  out["mlp"] = generator.mlp;
}

ResidualGenerator residual_generator_from_json(const json& in, const Chain& chain, const std::string& where) {
  ResidualGenerator generator;
  generator.kind = kind_from(text_from_json(in, "kind", where), where);
  const std::string target = text_from_json(in, "target", where);
  if (target != "state" && target != "change")
    throw Error(ErrorCode::input, where, "target: '" + target + "' is none of change, state");
  generator.target = target == "state" ? PredictedQuantity::state : PredictedQuantity::change;
  generator.shape = shape_from_json(member_of(in, "shape", where), where + ", shape");
  generator.uses_mean_torque = flag_from_json(in, "uses_mean_torque", where);
  generator.chain = chain;
  if (generator.joints() != chain.joints())
    throw Error(ErrorCode::input, where,
                fmt::format("the residual generator is of {} joints, the robot has {}", generator.joints(),
                            chain.joints()));
  const json& turns = member_of(in, "turns", where);
  if (!turns.is_array() || static_cast<int>(turns.size()) != generator.joints())
    throw Error(ErrorCode::input, where,
                fmt::format("turns: expected {} times true or false", generator.joints()));
  for (const json& turning : turns) generator.turns.push_back(turning.is_boolean() && turning.get<bool>());
  generator.healthy =
      healthy_from_json(member_of(in, "healthy", where), generator.joints(), where + ", healthy");
  if (generator.kind == ResidualKind::physics) return generator;
  generator.inputs = scaler_from_json(member_of(in, "inputs", where), where + ", inputs");
  generator.outputs = scaler_from_json(member_of(in, "outputs", where), where + ", outputs");
  generator.mlp = mlp_from_json(member_of(in, "mlp", where), where + ", mlp");
  check_network(generator, where);
  return generator;
}

}  // namespace faultline
