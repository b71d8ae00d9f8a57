// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "lib/identify/weak_form.hpp"

namespace faultline {
namespace {

constexpr double kLongestStep_s = 0.012;  ///< longer samples are integrated over by interpolation

/// Momentum and force of the base parameters and the friction terms at one state.
struct StateTerms {
  Eigen::MatrixXd momentum, force;  ///< joints x base
  Eigen::VectorXd rotor_momentum;
  Eigen::MatrixXd coulomb;  ///< joints x kWidths
};

StateTerms terms_at(const ParameterSpace& space, const Eigen::VectorXd& q, const Eigen::VectorXd& dq) {
  const LinkFrames frames = link_frames(space.chain, q);
  LinkRegressor y;
  StateTerms terms;
  momentum_regressor(frames, dq, y);
  terms.momentum = y * space.lift;
  force_regressor(frames, dq, y);
  terms.force = y * space.lift;
  terms.rotor_momentum.setZero(space.joints());
  terms.coulomb.resize(space.joints(), kWidths);
  for (int j = 0; j < space.joints(); ++j) {
    if (!space.chain.rotor_inertia.empty()) terms.rotor_momentum[j] = space.chain.rotor_inertia[j] * dq[j];
    for (int k = 0; k < kWidths; ++k) terms.coulomb(j, k) = std::tanh(dq[j] / weak_width(space, j, k));
  }
  return terms;
}

/// Position and velocity between two samples: cubic through both ends' positions and velocities.
void interpolate(const Stretch& s, int k, double x, Eigen::VectorXd& q, Eigen::VectorXd& dq) {
  const double h = s.time[k + 1] - s.time[k];
  const auto q0 = s.q_smooth.col(k), q1 = s.q_smooth.col(k + 1), v0 = s.dq_smooth.col(k),
             v1 = s.dq_smooth.col(k + 1);
  const double x2 = x * x, x3 = x2 * x;
  q = (2 * x3 - 3 * x2 + 1) * q0 + (x3 - 2 * x2 + x) * h * v0 + (3 * x2 - 2 * x3) * q1 + (x3 - x2) * h * v1;
  dq = (6 * x2 - 6 * x) / h * (q0 - q1) + (3 * x2 - 4 * x + 1) * v0 + (3 * x2 - 2 * x) * v1;
}

/// Means over one sample of the terms that are integrated.
struct StepMeans {
  Eigen::MatrixXd force, coulomb;
};

StepMeans step_means(const ParameterSpace& space, const Stretch& s, int k, const StateTerms& from,
                     const StateTerms& to) {
  StepMeans means{0.5 * (from.force + to.force), 0.5 * (from.coulomb + to.coulomb)};
  const int pieces = static_cast<int>(std::ceil((s.time[k + 1] - s.time[k]) / kLongestStep_s));
  Eigen::VectorXd q, dq;
  for (int i = 1; i < pieces; ++i) {
    interpolate(s, k, static_cast<double>(i) / pieces, q, dq);
    const StateTerms inside = terms_at(space, q, dq);
    means.force += inside.force;
    means.coulomb += inside.coulomb;
  }
  if (pieces > 1) {
    means.force /= pieces;
    means.coulomb /= pieces;
  }
  return means;
}

/// Smooth bump over (0, 1), zero with its slope at both ends.
double bump(double x) { return std::pow(4.0 * x * (1.0 - x), 2); }

/// Sample k of a stretch, from one state to the next.
struct Step {
  int k = 0;
  double weight = 1.0;
  const StateTerms& from;
  const StateTerms& to;
  const StepMeans& means;
};

/// Adds one sample's momentum balance to a window with the weight of the step.
void add_step(WeakWindow& window, const Stretch& s, const Step& step) {
  const auto& [k, weight, from, to, means] = step;
  const double dt = s.time[k + 1] - s.time[k];
  window.base += weight * (to.momentum - from.momentum - dt * means.force);
  window.viscous += weight * (s.q_smooth.col(k + 1) - s.q_smooth.col(k));
  window.coulomb += weight * dt * means.coulomb;
  window.timing += weight * dt * (s.tau.col(k + 1) - s.tau.col(k));
  window.torque += weight * (dt * s.tau.col(k) - (to.rotor_momentum - from.rotor_momentum));
}

WeakWindow empty_window(const ParameterSpace& space, const Stretch& s, int begin, int steps) {
  WeakWindow w;
  w.log = s.log;
  w.time_s = s.time[begin];
  w.rows = steps;
  w.base.setZero(space.joints(), space.rigid());
  w.coulomb.setZero(space.joints(), kWidths);
  w.viscous = w.timing = w.torque = Eigen::VectorXd::Zero(space.joints());
  w.speed = s.dq_smooth.middleCols(begin, steps + 1).cwiseAbs().rowwise().mean();
  w.travel = (s.q.middleCols(begin, steps + 1).rowwise().maxCoeff() -
              s.q.middleCols(begin, steps + 1).rowwise().minCoeff())
                 .sum();
  return w;
}

}  // namespace

double weak_width(const ParameterSpace& space, int joint, int k) {
  constexpr double kFactor[kWidths] = {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0};
  return kFactor[k] * space.chain.friction[joint].width;
}

WeakWindows::WeakWindows(const ParameterSpace& space, double window_s, int max_windows)
    : space_(space), window_s_(window_s), max_windows_(static_cast<std::size_t>(max_windows)) {}

void WeakWindows::keep(WeakWindow window) {
  if (seen_++ % stride_ != 0) return;
  windows_.push_back(std::move(window));
  if (windows_.size() <= max_windows_) return;
  std::vector<WeakWindow> half;
  for (std::size_t i = 0; i < windows_.size(); i += 2) half.push_back(std::move(windows_[i]));
  windows_ = std::move(half);
  stride_ *= 2;
}

void WeakWindows::add(const Stretch& s) {
  const int steps = std::max(1, static_cast<int>(std::lround(window_s_ / s.period_s)));
  const int hop = std::max(1, steps / 2);
  if (s.rows() <= steps) return;
  std::vector<StateTerms> terms;
  std::vector<StepMeans> means;
  for (int k = 0; k < s.rows(); ++k) terms.push_back(terms_at(space_, s.q_smooth.col(k), s.dq_smooth.col(k)));
  for (int k = 0; k + 1 < s.rows(); ++k) means.push_back(step_means(space_, s, k, terms[k], terms[k + 1]));
  if (static_cast<int>(rows_.size()) <= s.log) rows_.resize(s.log + 1, 0);
  for (int begin = 0; begin + steps < s.rows(); begin += hop) {
    if (s.outlier.middleCols(begin, steps + 1).any()) continue;
    WeakWindow window = empty_window(space_, s, begin, steps);
    std::vector<double> weight(steps, 1.0);
    for (int k = 0; k < steps && steps >= 4; ++k) weight[k] = bump((k + 0.5) / steps);
    double total = 0.0;
    for (int k = 0; k < steps; ++k) total += weight[k] * (s.time[begin + k + 1] - s.time[begin + k]);
    for (int k = 0; k < steps; ++k)
      add_step(window, s,
               {begin + k, weight[k] / total, terms[begin + k], terms[begin + k + 1], means[begin + k]});
    rows_[s.log] += hop;
    keep(std::move(window));
  }
}

std::int64_t WeakWindows::rows_used(int log) const {
  return log < static_cast<int>(rows_.size()) ? rows_[log] : 0;
}

}  // namespace faultline
