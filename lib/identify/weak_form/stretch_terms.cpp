// SPDX-License-Identifier: MIT
#include "lib/identify/weak_form/stretch_terms.hpp"

#include <cmath>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

constexpr double kTermsLongestStep_s = 0.012;  ///< longer samples are integrated over by interpolation

/// Momentum and force of the base parameters and the friction terms at one state.
struct StateTerms {
  Eigen::MatrixXd momentum, force;  ///< joints x base
  Eigen::MatrixXd coulomb;          ///< joints x kWidths
};

class StateEvaluation {
 public:
  explicit StateEvaluation(const ParameterSpace& space) : space_(space) {
    const int n = space.joints();
    links_ = space.lift.topRows(n * kLinkParameters);
    rotors_ = space.lift.bottomRows(n);
    widths_.resize(n, kWidths);
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < kWidths; ++k) widths_(j, k) = weak_width(space, j, k);
  }

  void operator()(const Eigen::VectorXd& q, const Eigen::VectorXd& dq, StateTerms& terms) {
    const LinkFrames frames = link_frames(space_.chain, q);
    momentum_regressor(frames, dq, regressor_);
    terms.momentum.noalias() = regressor_ * links_;
    terms.momentum += dq.asDiagonal() * rotors_;
    force_regressor(frames, dq, regressor_);
    terms.force.noalias() = regressor_ * links_;
    terms.coulomb.resize(space_.joints(), kWidths);
    for (int j = 0; j < space_.joints(); ++j)
      for (int k = 0; k < kWidths; ++k) terms.coulomb(j, k) = elementary::tanh(dq[j] / widths_(j, k));
  }

 private:
  const ParameterSpace& space_;
  Eigen::MatrixXd links_, rotors_, widths_;
  LinkRegressor regressor_;
};

/// Position and velocity between two samples: cubic through both ends' positions and velocities.
void interpolate(const Stretch& s, int k, double x, Eigen::VectorXd& q, Eigen::VectorXd& dq) {
  const double h = s.time[k + 1] - s.time[k];
  const auto q0 = s.q_smooth.col(k), q1 = s.q_smooth.col(k + 1), v0 = s.dq_smooth.col(k),
             v1 = s.dq_smooth.col(k + 1);
  const double x2 = x * x, x3 = x2 * x;
  q = (2 * x3 - 3 * x2 + 1) * q0 + (x3 - 2 * x2 + x) * h * v0 + (3 * x2 - 2 * x3) * q1 + (x3 - x2) * h * v1;
  dq = (6 * x2 - 6 * x) / h * (q0 - q1) + (3 * x2 - 4 * x + 1) * v0 + (3 * x2 - 2 * x) * v1;
}

/// Means over one sample of the terms that are integrated, from those at its ends and, on slow logs, within.
void add_inside(const Stretch& s, int k, StateEvaluation& evaluate, StateTerms& mean) {
  const int pieces = static_cast<int>(std::ceil((s.time[k + 1] - s.time[k]) / kTermsLongestStep_s));
  if (pieces < 2) return;
  Eigen::VectorXd q, dq;
  StateTerms inside;
  for (int i = 1; i < pieces; ++i) {
    interpolate(s, k, static_cast<double>(i) / pieces, q, dq);
    evaluate(q, dq, inside);
    mean.force += inside.force;
    mean.coulomb += inside.coulomb;
  }
  mean.force /= pieces;
  mean.coulomb /= pieces;
}

}  // namespace

double weak_width(const ParameterSpace& space, int joint, int k) {
  // Of the robot's own width: a quarter of a decade apart near the usual widths, coarser beyond.
  constexpr double kFactor[kWidths] = {0.01, 0.1, 0.3, 0.56, 1.0, 1.8, 3.0, 5.6, 10.0, 30.0, 100.0, 300.0};
  return kFactor[k] * space.chain.friction[joint].width;
}

StretchTerms stretch_terms(const ParameterSpace& space, const Stretch& s, const ExtraSetting& setting) {
  const int n = space.joints(), steps = s.rows() - 1;
  StretchTerms out;
  out.base.resize(static_cast<Eigen::Index>(n) * space.rigid(), steps);
  out.coulomb.resize(n * kWidths, steps);
  out.step_s = s.time.tail(steps) - s.time.head(steps);
  out.skew = 0.5 * (s.dq_smooth.rightCols(steps).cwiseAbs() + s.dq_smooth.leftCols(steps).cwiseAbs()) *
             out.step_s.asDiagonal();
  out.viscous = s.q_smooth.rightCols(steps) - s.q_smooth.leftCols(steps);
  const Eigen::VectorXd rotor = Eigen::Map<const Eigen::VectorXd>(space.chain.rotor_inertia.data(), n);
  out.rotor = rotor.asDiagonal() * (s.dq_smooth.rightCols(steps) - s.dq_smooth.leftCols(steps));
  out.extra = extra_columns(space, s, setting);
  StateEvaluation evaluate(space);
  StateTerms from, to, mean;
  evaluate(s.q_smooth.col(0), s.dq_smooth.col(0), from);
  for (int k = 0; k < steps; ++k) {
    evaluate(s.q_smooth.col(k + 1), s.dq_smooth.col(k + 1), to);
    mean.force = 0.5 * (from.force + to.force);
    mean.coulomb = 0.5 * (from.coulomb + to.coulomb);
    add_inside(s, k, evaluate, mean);
    Eigen::Map<Eigen::MatrixXd>(out.base.col(k).data(), n, space.rigid()) =
        to.momentum - from.momentum - out.step_s[k] * mean.force;
    Eigen::Map<Eigen::MatrixXd>(out.coulomb.col(k).data(), n, kWidths) = out.step_s[k] * mean.coulomb;
    std::swap(from, to);
  }
  return out;
}

}  // namespace faultline
