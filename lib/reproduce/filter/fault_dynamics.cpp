// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/fault_dynamics.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "lib/core/matrix/decompositions.hpp"
#include "lib/reproduce/filter/small_inverse.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/robot/payload.hpp"

namespace faultline {
namespace {

constexpr int kPositions = 32;
constexpr double kWide = 3.0;  // rad or m
constexpr double kGolden = 0.6180339887498949;
constexpr double kMostTakenOff = 0.9;  // of the mass that the tip feels like

/// Joint positions spread over the healthy range, and widely where it is not known: multiples of
/// irrational shares (Weyl's sequence).
JointVector<double> spread_position(const MotionModel& model, int i) {
  JointVector<double> q(model.joints());
  double irrational = 0.0;
  for (int j = 0; j < model.joints(); ++j) {
    irrational = std::fmod(irrational + kGolden, 1.0);
    const double share = std::fmod((i + 0.5) * irrational, 1.0);
    const bool known = j < static_cast<int>(model.q_low.size());
    const double low = known ? model.q_low[j] : -kWide, high = known ? model.q_high[j] : kWide;
    q[j] = low + share * (high - low);
  }
  return q;
}

/// A mass at the tip adds m D(q) to M(q): M + m D stays positive definite down to -1 over the largest
/// eigenvalue of M^-1 D, the mass that the tip feels like in its easiest direction.
double least_payload_of(const RobotLoad& load) {
  const JointVector<double> still = JointVector<double>::Zero(load.model.joints());
  double largest = 0.0;
  for (int i = 0; i < kPositions; ++i) {
    const JointVector<double> q = spread_position(load.model, i);
    JointMatrix<double> inertia, loaded;
    JointVector<double> bias;
    load.healthy.inertia_and_bias(q, still, inertia, bias);
    load.unit_payload.inertia_and_bias(q, still, loaded, bias);
    const Eigen::LLT<Eigen::MatrixXd> factor(inertia);
    if (factor.info() != Eigen::Success) continue;
    const Eigen::MatrixXd more = loaded - inertia;
    const Eigen::MatrixXd half = factor.matrixL().solve(more);
    const Eigen::MatrixXd scaled = factor.matrixL().solve(half.transpose());
    largest = std::max(largest, symmetric_eigenvalues(scaled).maxCoeff());
  }
  return largest > 0.0 ? -kMostTakenOff / largest : 0.0;
}

}  // namespace

RobotLoad::RobotLoad(const MotionModel& motion_model)
    : model(motion_model),
      healthy(motion_model.chain),
      unit_payload(with_payload(motion_model.chain, motion_model.chain.joints() - 1, 1.0)),
      payload_bodies(healthy.planar() ? healthy.bodies_more_in(unit_payload) : FastDynamics::Bodies{}),
      least_payload(least_payload_of(*this)) {}

FaultDynamics::FaultDynamics(const MotionModel& model) : load_(model) {}

JointArray FaultDynamics::stopping_impulse(const MotionState& at, int j) const {
  const int n = joints();
  const JointVector<double> q = Eigen::Map<const Eigen::VectorXd>(at.q.data(), n);
  JointSquare inverse;
  invert_inertia(inertia_matrix(load_.model.chain, q), -1, inverse);
  JointArray change{};
  const double impulse = -at.dq[j] / inverse[j * n + j];
  for (int i = 0; i < n; ++i) change[i] = inverse[i * n + j] * impulse;
  return change;
}

}  // namespace faultline
