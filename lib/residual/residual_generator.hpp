// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lib/neural/mlp.hpp"
#include "lib/neural/patterns.hpp"
#include "lib/residual/transitions.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

/// The predictor of the fault-free motion.
enum class ResidualKind {
  mlp,      ///< the paper: a network from (q, dq, tau) now to (q, dq) one step later
  physics,  ///< the identified robot, integrated over the step
  hybrid,   ///< physics, and a network that predicts its residual
};
const char* to_string(ResidualKind kind);

/// The output of the network of kind `mlp`.
enum class PredictedQuantity {
  change,  ///< of q and dq over the step; exact at short steps
  state,   ///< q and dq after the step, as in the paper
};

/// Residuals of the robot when healthy, on patterns that were not trained on; SI units, a joint each.
struct HealthyResiduals {
  int patterns = 0;
  Eigen::VectorXd position_rms, velocity_rms, torque_rms;
  Eigen::VectorXd position_max, velocity_max, torque_max;  ///< largest magnitudes
};

/// Predicts (q, dq) one step ahead for a healthy robot.
struct ResidualGenerator {
  ResidualKind kind = ResidualKind::mlp;
  PredictedQuantity target = PredictedQuantity::change;
  TransitionShape shape;
  bool uses_mean_torque = false;  ///< inputs also hold the mean torque over the step
  std::vector<char> turns;  ///< 1 for a revolute joint with a range of about a turn: its inputs are sine and
                            ///< cosine, differences are taken modulo a turn
  Chain chain;              ///< the identified robot
  Scaler inputs, outputs;   ///< of the network
  Mlp mlp;                  ///< empty for kind physics
  HealthyResiduals healthy;

  int joints() const { return shape.joints; }
  bool predicts_state() const { return kind == ResidualKind::mlp && target == PredictedQuantity::state; }
};

/// Inputs of the network for each transition: q (or its sine), dq, tau and, if used, the mean torque, then
/// the cosine of joints with `turns`; inputs x transitions, not scaled.
Eigen::MatrixXd network_inputs(const ResidualGenerator& generator, const Transitions& transitions);

/// Outputs of the network for each transition, in SI units: change of q and dq over the nominal duration (for
/// kind `hybrid` the residual of physics), or both after it (target `state`). 2 joints x transitions. Not for
/// kind `physics`, which has no network.
Eigen::MatrixXd network_outputs(const ResidualGenerator& generator, const Transitions& transitions);

/// Change of q (upper half) and dq (lower half) over each transition that physics predicts; zero for kind
/// `mlp`. 2 joints x transitions.
Eigen::MatrixXd base_change(const ResidualGenerator& generator, const Transitions& transitions);

/// Predicted change of q and dq, 2 joints x transitions. NaN if an input is missing or the log has a gap.
Eigen::MatrixXd predicted_change(const ResidualGenerator& generator, const Transitions& transitions);
/// Measured change of q and dq, modulo a turn for joints with `turns`.
Eigen::MatrixXd measured_change(const ResidualGenerator& generator, const Transitions& transitions);

void to_json(nlohmann::json& json, const ResidualGenerator& generator);
/// The chain is not in the JSON: it belongs to the robot, which the model keeps. Throws Error(input) when
/// something is missing or does not fit the robot; `where` names the file.
ResidualGenerator residual_generator_from_json(const nlohmann::json& json, const Chain& chain,
                                               const std::string& where);

}  // namespace faultline
