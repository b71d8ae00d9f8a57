// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "lib/reproduce/filter/prediction.hpp"
#include "tests/reproduce/filter/mechanical_faults.hpp"

namespace faultline::mechanical {

/// The closed-form robot with a model without process noise and with priors small enough to be linear.
struct PredictionWorld : Twin {
  FaultyScara::State start{{0.3, 0.8, -0.1}, {1.0, -0.7, -0.3}};  ///< far from where friction bends
  FaultyScara::Triple torque = {6.5, -3.0, 12.0};
  double q_std = 0.002, dq_std = 0.01;

  PredictionWorld() {
    model.noise.floor = {0.0, 0.0, 0.0};
    model.noise.torque_share = model.noise.rest_share = model.noise.step_share = 0.0;
    model.priors.external_torque = {2.0, 1.0, 4.0};
    model.priors.payload = 0.2;
    model.priors.viscous_increase = {1.0, 0.5, 4.0};
    model.priors.coulomb_increase = {1.0, 0.5, 2.0};
  }

  Step step(double dt) const { return {.dt = dt, .torque = torque, .next_torque = torque}; }

  /// The healthy state before the step; the velocity of a locked joint is known to be 0.
  GaussianState before(int locked = -1) const {
    GaussianState state;
    state.size = 6;
    state.covariance.fill(0.0);
    for (int j = 0; j < 3; ++j) {
      state.mean[j] = start.q[j];
      state.mean[3 + j] = j == locked ? 0.0 : start.dq[j];
      state.p(j, j) = q_std * q_std;
      state.p(3 + j, 3 + j) = j == locked ? 0.0 : dq_std * dq_std;
    }
    return state;
  }
};

/// The hypotheses whose faults act on the motion, each with as many sizes as the bank gives it.
inline std::vector<Hypothesis> moving_hypotheses() {
  return {{{FaultKind::free_swinging, 1}, 0.0, HypothesisForm::usual, 0},
          {{FaultKind::free_swinging, 3}, 0.0, HypothesisForm::usual, 0},
          {{FaultKind::torque_loss, 1}, 0.0, HypothesisForm::usual, 1},
          {{FaultKind::torque_loss, 2}, 0.0, HypothesisForm::usual, 1},
          {{FaultKind::locked, 2}, 0.0, HypothesisForm::usual, 0},
          {{FaultKind::friction_increase, 1}, 0.0, HypothesisForm::usual, 2},
          {{FaultKind::friction_increase, 3}, 0.0, HypothesisForm::usual, 2},
          {{FaultKind::payload_change, 3}, 0.0, HypothesisForm::usual, 1},
          {{FaultKind::collision, 2}, 0.1, HypothesisForm::usual, 1},
          {{FaultKind::collision, 0}, 0.1, HypothesisForm::push_on_all_joints, 3},
          {{FaultKind::unknown, 1}, 0.0, HypothesisForm::usual, 1}};
}

inline FaultyScara::State state_of(const Eigen::VectorXd& x) {
  FaultyScara::State out;
  for (int j = 0; j < 3; ++j) out.q[j] = x[j], out.dq[j] = x[3 + j];
  return out;
}

/// The faulty robot when the state is `x` with the hypothesis' sizes behind q and dq.
inline FaultyScara robot_under(const Hypothesis& hypothesis, const Eigen::VectorXd& x) {
  FaultyScara::Triple size{};
  for (int s = 0; s < hypothesis.sizes; ++s) size[s] = x[6 + s];
  return fault_of(hypothesis.label.kind, hypothesis.label.joint, size).truth;
}

inline Eigen::VectorXd mean_of(const GaussianState& state) {
  return Eigen::Map<const Eigen::VectorXd>(state.mean.data(), state.size);
}

inline Eigen::MatrixXd covariance_of(const GaussianState& state) {
  Eigen::MatrixXd p(state.size, state.size);
  for (int i = 0; i < state.size; ++i)
    for (int j = 0; j < state.size; ++j) p(i, j) = state.p(i, j);
  return p;
}

/// Mean and covariance of what `move` makes of states drawn from `before` (a diagonal covariance).
struct Sampled {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};
template <typename Move>
Sampled monte_carlo(const GaussianState& before, int draws, const Move& move) {
  Random random(17);
  Eigen::MatrixXd samples(before.size, draws);
  for (int k = 0; k < draws; ++k) {
    Eigen::VectorXd x = mean_of(before);
    for (int i = 0; i < before.size; ++i) x[i] += std::sqrt(before.p(i, i)) * random.normal();
    const FaultyScara::State after = move(x, random);
    for (int j = 0; j < 3; ++j) x[j] = after.q[j], x[3 + j] = after.dq[j];
    samples.col(k) = x;
  }
  Sampled out;
  out.mean = samples.rowwise().mean();
  samples.colwise() -= out.mean;
  out.covariance = samples * samples.transpose() / (draws - 1.0);
  return out;
}

/// Largest difference of two covariances, each entry over the standard deviations of its row and column.
inline double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < a.cols(); ++j) {
      const double scale = std::sqrt(b(i, i) * b(j, j));
      largest = std::max(largest, std::abs(a(i, j) - b(i, j)) / std::max(scale, 1e-12));
    }
  return largest;
}

}  // namespace faultline::mechanical
