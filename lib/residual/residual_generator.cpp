// SPDX-License-Identifier: MIT
#include "lib/residual/residual_generator.hpp"

#include <cmath>
#include <numbers>

#include "lib/core/elementary/elementary.hpp"
#include "lib/residual/physics_step.hpp"

namespace faultline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

bool has_physics(const ResidualGenerator& generator) { return generator.kind != ResidualKind::mlp; }

bool predicts_state(const ResidualGenerator& generator) {
  return generator.kind == ResidualKind::mlp && generator.target == PredictedQuantity::state;
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
  if (!has_physics(generator)) return change;
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
  if (!predicts_state(generator)) return change + (outputs.array().rowwise() * stretch.array()).matrix();
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

}  // namespace faultline
