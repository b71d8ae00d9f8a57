// SPDX-License-Identifier: MIT
#include "lib/reproduce/classifier/transition_posterior.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "lib/core/elementary/elementary.hpp"
#include "lib/reproduce/protocol/protocol.hpp"
#include "lib/robot/runge_kutta.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRidge = 1e-6;  // share of each input's power
constexpr std::size_t kNeighbours = 20;
constexpr double kShareOfAll = 0.01;  // of the overall covariance, so that the local one has full rank

constexpr int kSteps = 10;  // of Runge-Kutta, over a sample

constexpr double kStep = 1e-4;      // of the finite differences, in half ranges
constexpr double kRounding = 1e-6;  // half ranges: what integration and linear model leave at least
constexpr double kPosteriorLinearTorque = 0.5;

/// One pattern: the state and torque at its start, and the torque at its end as far as it is known.
struct Sample {
  VectorXd state, tau, next_tau, later;
};

Sample sample(const Transitions& transitions, int i) {
  Sample s;
  s.state.resize(2 * transitions.q.rows());
  s.later.resize(s.state.size());
  s.state << transitions.q.col(i), transitions.dq.col(i);
  s.later << transitions.next_q.col(i), transitions.next_dq.col(i);
  s.tau = transitions.tau.col(i);
  s.next_tau = s.tau + (transitions.mean_tau.col(i) - s.tau) / kPosteriorLinearTorque;
  return s;
}

/// From torque to the state a sample later: dt^2 M^-1 for q, dt M^-1 for dq.
MatrixXd state_per_torque(const SampleModel& model, const VectorXd& state) {
  const auto n = state.size() / 2;
  JointMatrix inertia;
  JointVector bias;
  model.dynamics().inertia_and_bias(state.head(n), state.tail(n), inertia, bias);
  const MatrixXd inverse = inertia.inverse();
  MatrixXd both = MatrixXd::Zero(2 * n, 2 * n);
  both.topLeftCorner(n, n) = kSamplePeriod * kSamplePeriod * inverse;
  both.bottomRightCorner(n, n) = kSamplePeriod * inverse;
  return both;
}

/// What the trend is linear in.
VectorXd regressors(const SampleModel& model, const Sample& s, const VectorXd& state, int output) {
  const auto n = state.size() / 2;
  JointVector applied = s.tau, ddq;
  if (output < kFaultClasses - 1) applied[output] = 0.0;
  model.dynamics().acceleration(state.head(n), state.tail(n), applied, ddq);
  VectorXd all(1 + 3 * n);
  all << 1.0, state.tail(n), s.tau, ddq;
  return all;
}

VectorXd predicted(const SampleModel& model, const Sample& s, const VectorXd& state, int output) {
  const auto n = state.size() / 2;
  const JointState end = model.next({state.head(n), state.tail(n)}, s.tau, s.next_tau, output);
  VectorXd later(2 * n);
  later << end.q, end.dq;
  return later;
}

VectorXd predicted(const TransitionModel& model, const Sample& s, const VectorXd& state, int output) {
  return predicted(model.sample, s, state, output) +
         state_per_torque(model.sample, state) *
             mean_at(model.between[output], regressors(model.sample, s, state, output));
}

MatrixXd jacobian(const TransitionModel& model, const Sample& s, const VectorXd& half, int output) {
  MatrixXd slope(s.state.size(), s.state.size());
  for (Eigen::Index k = 0; k < s.state.size(); ++k) {
    VectorXd up = s.state, down = s.state;
    up[k] += kStep * half[k];
    down[k] -= kStep * half[k];
    slope.col(k) =
        (predicted(model, s, up, output) - predicted(model, s, down, output)) / (2.0 * kStep * half[k]);
  }
  return slope;
}

double log_likelihood(const TransitionModel& model, const Sample& s, const VectorXd& half, double sigma,
                      int output) {
  const MatrixXd noise = (sigma * sigma * half.cwiseAbs2()).asDiagonal();
  const MatrixXd effect = state_per_torque(model.sample, s.state);
  const MatrixXd slope = sigma > 0.0 ? jacobian(model, s, half, output) : MatrixXd(0.0 * effect);
  const MatrixXd between = covariance_at(model.between[output], regressors(model.sample, s, s.state, output));
  MatrixXd covariance = slope * noise * slope.transpose() + noise + effect * between * effect.transpose();
  covariance.diagonal() += (kRounding * half).cwiseAbs2();
  const VectorXd off = s.later - predicted(model, s, s.state, output);
  // In half ranges, so that the factor is well conditioned.
  const MatrixXd scaled = half.cwiseInverse().asDiagonal() * covariance * half.cwiseInverse().asDiagonal();
  const Eigen::LLT<MatrixXd> factor(scaled);
  const VectorXd whitened = factor.matrixL().solve(off.cwiseQuotient(half));
  return -0.5 * whitened.squaredNorm() -
         factor.matrixLLT().diagonal().array().unaryExpr(&elementary::log).sum();
}

}  // namespace

LocalGaussian fit_local_gaussian(const MatrixXd& inputs, const MatrixXd& outputs) {
  LocalGaussian gaussian;
  const double count = static_cast<double>(inputs.cols());
  MatrixXd gram = inputs * inputs.transpose();
  gram.diagonal() *= 1.0 + kRidge;
  gaussian.trend = gram.ldlt().solve(inputs * outputs.transpose()).transpose();
  gaussian.scale = (inputs.rowwise().norm() / std::sqrt(count)).cwiseMax(1e-12);
  gaussian.inputs = gaussian.scale.cwiseInverse().asDiagonal() * inputs;
  gaussian.rest = outputs - gaussian.trend * inputs;
  gaussian.covariance = gaussian.rest * gaussian.rest.transpose() / count;
  return gaussian;
}

VectorXd mean_at(const LocalGaussian& gaussian, const VectorXd& input) { return gaussian.trend * input; }

MatrixXd covariance_at(const LocalGaussian& gaussian, const VectorXd& input) {
  const VectorXd scaled = input.cwiseQuotient(gaussian.scale);
  const VectorXd distance = (gaussian.inputs.colwise() - scaled).colwise().squaredNorm();
  std::vector<int> order(distance.size());
  std::iota(order.begin(), order.end(), 0);
  const std::size_t count = std::min(kNeighbours, order.size());
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count - 1), order.end(),
                   [&](int a, int b) { return distance[a] < distance[b]; });
  order.resize(count);
  const MatrixXd near = gaussian.rest(Eigen::all, order);
  return near * near.transpose() / static_cast<double>(count) + kShareOfAll * gaussian.covariance;
}

SampleModel::SampleModel(const Robot& robot, ControllerVariant controller, TorqueBetween between)
    : dynamics_(robot.chain),
      reading_(controller),
      between_(between),
      controller_(robot, controller_spec(controller), kControlPeriod) {}

/// Where pd wants to be: its torque is linear in the set-point of the joint.
JointVector SampleModel::set_point(const JointState& now, const JointVector& tau) const {
  Reference there{now.q, JointVector::Zero(now.q.size()), JointVector::Zero(now.q.size())};
  JointVector here_torque(now.q.size()), beyond_torque(now.q.size());
  controller_.torque(there, now.q, now.dq, here_torque);
  there.q.array() += 1.0;
  controller_.torque(there, now.q, now.dq, beyond_torque);
  return now.q + ((tau - here_torque).array() / (beyond_torque - here_torque).array()).matrix();
}

JointState SampleModel::next(const JointState& now, const JointVector& tau, const JointVector& next_tau,
                             int output) const {
  const bool follows = between_ == TorqueBetween::controlled && reading_ != ControllerVariant::held;
  const bool pd = reading_ == ControllerVariant::pd;
  Reference reference{now.q, JointVector::Zero(now.q.size()), JointVector::Zero(now.q.size())};
  if (follows && pd) reference.q = set_point(now, tau);
  if (follows && !pd) dynamics_.acceleration(now.q, now.dq, tau, reference.ddq);
  const auto acceleration = [&](double time, const JointVector& q, const JointVector& dq, JointVector& ddq) {
    JointVector applied = tau;
    if (between_ == TorqueBetween::linear) applied += time / kSamplePeriod * (next_tau - tau);
    if (follows && !pd) {  // on its way: no error to correct
      reference.q = q;
      reference.dq = dq;
    }
    if (follows) controller_.torque(reference, q, dq, applied);
    if (output < kFaultClasses - 1) applied[output] = 0.0;
    dynamics_.acceleration(q, dq, applied, ddq);
  };
  const double h = kSamplePeriod / kSteps;
  JointState x = now;
  JointVector a1;
  for (int i = 0; i < kSteps; ++i) {
    const double t = i * h;
    acceleration(t, x.q, x.dq, a1);
    runge_kutta_step(
        h, a1,
        [&](double after, const JointVector& q, const JointVector& dq, JointVector& ddq) {
          acceleration(t + after, q, dq, ddq);
        },
        x.q, x.dq);
  }
  return x;
}

TransitionModel learn_transition_model(SampleModel sample_model, const FaultPatterns& patterns) {
  TransitionModel model{std::move(sample_model), {}};
  for (int output = 0; output < kFaultClasses; ++output) {
    const Transitions& known = patterns.of_class[output];
    MatrixXd left(2 * known.q.rows(), known.count()), causes(1 + 3 * known.q.rows(), known.count());
    for (int i = 0; i < known.count(); ++i) {
      const Sample s = sample(known, i);
      const VectorXd error = s.later - predicted(model.sample, s, s.state, output);
      left.col(i) = state_per_torque(model.sample, s.state).inverse() * error;
      causes.col(i) = regressors(model.sample, s, s.state, output);
    }
    model.between[output] = fit_local_gaussian(causes, left);
  }
  return model;
}

MatrixXd transition_posterior(const TransitionModel& model, const Transitions& transitions,
                              const HalfRanges& ranges, double sigma) {
  const VectorXd half = ranges.state();
  const Eigen::Array4d prior = table_1_prior();
  MatrixXd posterior(kFaultClasses, transitions.count());
  for (int i = 0; i < transitions.count(); ++i) {
    const Sample s = sample(transitions, i);
    Eigen::Array4d log_probability = prior.unaryExpr(&elementary::log);
    for (int output = 0; output < kFaultClasses; ++output)
      log_probability[output] += log_likelihood(model, s, half, sigma, output);
    const Eigen::Array4d share = (log_probability - log_probability.maxCoeff()).unaryExpr(&elementary::exp);
    posterior.col(i) = (share / share.sum()).matrix();
  }
  return posterior;
}

double posterior_error(const TransitionModel& model, const FaultPatterns& patterns, const HalfRanges& ranges,
                       double sigma) {
  double sum = 0.0;
  for (int output = 0; output < kFaultClasses; ++output) {
    MatrixXd posterior = transition_posterior(model, patterns.of_class[output], ranges, sigma);
    posterior.row(output).array() -= 1.0;
    sum += posterior.squaredNorm();
  }
  return sum / (static_cast<double>(kFaultClasses) * patterns.count());
}

}  // namespace faultline
