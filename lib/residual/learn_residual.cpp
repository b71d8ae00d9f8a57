// SPDX-License-Identifier: MIT
#include "lib/residual/learn_residual.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "lib/core/error.hpp"
#include "lib/core/statistics.hpp"
#include "lib/residual/physics_step.hpp"
#include "lib/residual/residuals.hpp"
#include "lib/residual/transitions.hpp"

namespace faultline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Training targets of the network for each transition, in SI units.
MatrixXd network_targets(const ResidualGenerator& generator, const Transitions& transitions) {
  const MatrixXd change = measured_change(generator, transitions);
  if (generator.predicts_state()) {
    MatrixXd state = change;
    state.topRows(generator.joints()) += transitions.q;
    state.bottomRows(generator.joints()) += transitions.dq;
    return state;
  }
  return change - base_change(generator, transitions);
}

Patterns scaled_patterns(const ResidualGenerator& generator, const Transitions& transitions) {
  return {generator.inputs.apply(network_inputs(generator, transitions)),
          generator.outputs.apply(network_targets(generator, transitions))};
}

Mlp train_network(const Patterns& training, const Patterns& validation, const ResidualOptions& options,
                  const Progress& progress) {
  const int inputs = static_cast<int>(training.inputs.rows()),
            outputs = static_cast<int>(training.targets.rows());
  Mlp start = make_mlp({inputs, options.hidden, outputs}, OutputKind::linear, options.seed);
  TrainingOptions trainer{.weight_decay = options.weight_decay, .seed = options.seed};
  if (options.trainer == ResidualTrainer::back_propagation) {
    trainer.max_iterations = options.max_iterations > 0 ? options.max_iterations : 1500;
    trainer.patience = trainer.max_iterations;
    return train_back_propagation(std::move(start), training, validation, trainer, progress);
  }
  trainer.max_iterations = options.max_iterations > 0 ? options.max_iterations : 25;
  return train_levenberg_marquardt(std::move(start), training, validation, trainer, progress);
}

VectorXd rms_of(const MatrixXd& values) { return values.array().square().rowwise().mean().sqrt().matrix(); }
VectorXd largest_of(const MatrixXd& values) { return values.cwiseAbs().rowwise().maxCoeff(); }

constexpr int kLeastPatterns = 50;  // fewer training patterns do not determine the motion
/// Time to predict over, s, rounded down to whole rows, at least one: at 1 kHz the velocity changes by more
/// than its noise, at 13.7 Hz it is one row.
constexpr double kStep_s = 0.02;
constexpr int kPredictionsOfRow = 3;  // about so many predictions contain a row

/// Summary of the logs from a first pass.
struct Survey {
  double period_s = 0.0;
  bool has_velocity = true;
  std::int64_t rows = 0;
  VectorXd low, high;  // of q
};

void widen(Survey& survey, const Log& segment) {
  for (int j = 0; j < segment.joints(); ++j)
    for (double q : segment.q[j]) {
      if (!std::isfinite(q)) continue;
      survey.low[j] = std::min(survey.low[j], q);
      survey.high[j] = std::max(survey.high[j], q);
    }
}

Survey survey_logs(std::span<LogSource* const> logs, int joints) {
  constexpr std::size_t kEnough = 100000;  // periods for a median
  Survey survey;
  survey.low = VectorXd::Constant(joints, std::numeric_limits<double>::infinity());
  survey.high = -survey.low;
  std::vector<double> periods;
  Log segment;
  for (LogSource* log : logs) {
    log->rewind();
    while (log->next(segment)) {
      if (segment.joints() != joints || static_cast<int>(segment.tau.size()) != joints)
        throw Error(ErrorCode::input, log->identity().path,
                    fmt::format("has {} positions and {} torques, but the robot has {} joints; check that it "
                                "is a log of this robot",
                                segment.joints(), segment.tau.size(), joints));
      survey.has_velocity = survey.has_velocity && static_cast<int>(segment.dq.size()) == joints;
      widen(survey, segment);
      survey.rows += segment.rows();
      for (int i = 1; i < segment.rows() && periods.size() < kEnough; ++i)
        periods.push_back(segment.time[i] - segment.time[i - 1]);
    }
  }
  if (periods.empty()) throw Error(ErrorCode::input, "healthy logs", "do not have two rows to learn from");
  survey.period_s = upper_median_of(periods);
  return survey;
}

TransitionShape shape_for(const Survey& survey, int joints, double torque_phi) {
  constexpr double kTolerance = 1e-6;  // rows
  TransitionShape shape;
  shape.joints = joints;
  shape.step = std::max(1, static_cast<int>(kStep_s / survey.period_s + kTolerance));
  shape.stride = std::max(1, shape.step / kPredictionsOfRow);
  shape.step_s = shape.step * survey.period_s;
  shape.torque_phi = torque_phi;
  shape.derive_velocity = !survey.has_velocity;
  return shape;
}

/// Predictions that stay together in training, validation or check: 3 s of them, fewer when the logs are
/// short.
std::int64_t block_size(const Survey& survey, const TransitionShape& shape) {
  const double together_s = 3.0;
  const auto whole = static_cast<std::int64_t>(together_s / (survey.period_s * shape.stride));
  return std::max<std::int64_t>(8, std::min(whole, survey.rows / shape.stride / 40));
}

/// Transitions for training, validation and measuring, from blocks that do not overlap.
struct Pools {
  TransitionReservoir training, validation, check;
};

bool usable(const Transitions& t, int column) {
  return std::isfinite(t.duration[column]) && t.q.col(column).allFinite() && t.dq.col(column).allFinite() &&
         t.mean_tau.col(column).allFinite() && t.next_q.col(column).allFinite() &&
         t.next_dq.col(column).allFinite();
}

Pools draw(std::span<LogSource* const> logs, const TransitionShape& shape, std::int64_t block,
           const ResidualOptions& options, const Progress& progress) {
  Pools pools{{options.max_patterns, options.seed},
              {std::max(options.max_patterns / 4, 1), options.seed + 1},
              {std::max(options.max_patterns, 5000), options.seed + 2}};
  Log segment;
  std::int64_t offered = 0;
  for (std::size_t l = 0; l < logs.size(); ++l) {
    if (progress) progress("drawing patterns", static_cast<double>(l) / static_cast<double>(logs.size()));
    logs[l]->rewind();
    TransitionState state;
    while (logs[l]->next(segment)) {
      const Transitions transitions = collect_transitions(segment, shape, state);
      for (int i = 0; i < transitions.count(); ++i, ++offered) {
        if (!usable(transitions, i)) continue;
        const auto turn = offered / block % 10;
        (turn == 5                ? pools.validation
         : turn == 2 || turn == 8 ? pools.check
                                  : pools.training)
            .offer(transitions, i);
      }
    }
  }
  return pools;
}

/// Returns what was learned with its mean squared errors on these transitions.
LearnedResidual with_errors(LearnedResidual learned, const Transitions& check) {
  const ResidualGenerator& generator = learned.generator;
  MatrixXd state(2 * generator.joints(), check.count());
  state << check.next_q, check.next_dq;
  const VectorXd factor = range_scaler(state).factor;
  const MatrixXd change = measured_change(generator, check);
  const MatrixXd error = change - predicted_change(generator, check);
  learned.normalised_mse = (factor.asDiagonal() * error).squaredNorm() / static_cast<double>(error.size());
  learned.persistence_mse = (factor.asDiagonal() * change).squaredNorm() / static_cast<double>(change.size());
  return learned;
}

ResidualGenerator untrained(const Robot& robot, const Survey& survey, const TransitionShape& shape,
                            const ResidualOptions& options) {
  ResidualGenerator generator;
  generator.kind = options.kind;
  generator.target = options.target;
  generator.shape = shape;
  generator.uses_mean_torque = shape.step > 1 || shape.torque_phi != 0.0;
  generator.chain = robot.chain;
  for (int j = 0; j < robot.joints(); ++j)
    generator.turns.push_back(robot.chain.geometry[j].kind == AxisKind::revolute &&
                              survey.high[j] - survey.low[j] > 0.95 * 2.0 * std::numbers::pi);
  return generator;
}

void check_amount(const Pools& pools) {
  const auto found = pools.training.offered() + pools.validation.offered() + pools.check.offered();
  if (pools.training.offered() < kLeastPatterns || pools.check.offered() == 0)
    throw Error(ErrorCode::input, "healthy logs",
                fmt::format("hold only {} usable steps of the motion; at least {} are needed to learn it: "
                            "record longer logs, and check for gaps and missing numbers",
                            found, 2 * kLeastPatterns));
}

}  // namespace

ResidualGenerator fit_residual_generator(ResidualGenerator generator, const Transitions& training,
                                         const Transitions& validation, const ResidualOptions& options,
                                         const Progress& progress) {
  if (generator.kind == ResidualKind::physics) return generator;
  generator.inputs = range_scaler(network_inputs(generator, training));
  generator.outputs = range_scaler(network_targets(generator, training));
  Patterns held_back;
  if (validation.count() > 0) held_back = scaled_patterns(generator, validation);
  generator.mlp = train_network(scaled_patterns(generator, training), held_back, options, progress);
  return generator;
}

HealthyResiduals healthy_residuals(ResidualGenerator generator, const Transitions& check) {
  const Index n = generator.joints();
  HealthyResiduals& healthy = generator.healthy;
  healthy.patterns = check.count();
  healthy.position_rms = healthy.velocity_rms = healthy.torque_rms =
      VectorXd::Ones(n);  // so that units stay SI
  const Residuals r = residuals_of(generator, check);
  // A residual of exactly zero (a joint that never moved) must not become a division by zero.
  const auto at_least = [](const VectorXd& rms) -> VectorXd { return rms.cwiseMax(1e-12); };
  healthy.position_rms = at_least(rms_of(r.position));
  healthy.velocity_rms = at_least(rms_of(r.velocity));
  healthy.torque_rms = at_least(rms_of(r.torque));
  healthy.position_max = largest_of(r.position);
  healthy.velocity_max = largest_of(r.velocity);
  healthy.torque_max = largest_of(r.torque);
  return healthy;
}

LearnedResidual learn_residual_generator(std::span<LogSource* const> logs, const Robot& identified,
                                         double torque_phi, const ResidualOptions& options,
                                         const Progress& progress) {
  const Survey survey = survey_logs(logs, identified.joints());
  const TransitionShape shape = shape_for(survey, identified.joints(), torque_phi);
  const Pools pools = draw(logs, shape, block_size(survey, shape), options, progress);
  check_amount(pools);
  const Transitions check = pools.check.drawn();
  Transitions training = pools.training.drawn();

  if (options.kind == ResidualKind::mlp && identified.identified && options.twin_share > 0.0)
    training =
        joined(training, twin_transitions(training, shape, identified.chain,
                                          static_cast<int>(options.twin_share * options.max_patterns)));
  LearnedResidual learned;
  learned.training_patterns = training.count();
  const Transitions validation = pools.validation.drawn();
  learned.generator = fit_residual_generator(untrained(identified, survey, shape, options), training,
                                             validation, options, progress);
  learned.generator.healthy = healthy_residuals(learned.generator, check);
  return with_errors(std::move(learned), check);
}

}  // namespace faultline
