// SPDX-License-Identifier: MIT
#include "lib/reproduce/classifier/sample_model.hpp"

#include "lib/reproduce/classifier/fault_trajectories.hpp"
#include "lib/robot/runge_kutta.hpp"

namespace faultline {
namespace {

using Vector = JointVector;

constexpr int kSteps = 10;  // of Runge-Kutta, over a sample

}  // namespace

SampleModel::SampleModel(const Robot& robot, ControllerVariant controller, TorqueBetween between)
    : dynamics_(robot.chain),
      reading_(controller),
      between_(between),
      controller_(robot, controller_spec(controller), kControlPeriod) {}

/// Where pd wants to be: its torque is linear in the set-point of the joint.
Vector SampleModel::set_point(const JointState& now, const Vector& tau) const {
  Reference there{now.q, Vector::Zero(now.q.size()), Vector::Zero(now.q.size())};
  Vector here_torque(now.q.size()), beyond_torque(now.q.size());
  controller_.torque(there, now.q, now.dq, here_torque);
  there.q.array() += 1.0;
  controller_.torque(there, now.q, now.dq, beyond_torque);
  return now.q + ((tau - here_torque).array() / (beyond_torque - here_torque).array()).matrix();
}

JointState SampleModel::next(const JointState& now, const Vector& tau, const Vector& next_tau,
                             int output) const {
  const bool follows = between_ == TorqueBetween::controlled && reading_ != ControllerVariant::held;
  const bool pd = reading_ == ControllerVariant::pd;
  Reference reference{now.q, Vector::Zero(now.q.size()), Vector::Zero(now.q.size())};
  if (follows && pd) reference.q = set_point(now, tau);
  if (follows && !pd) dynamics_.acceleration(now.q, now.dq, tau, reference.ddq);
  const auto acceleration = [&](double time, const Vector& q, const Vector& dq, Vector& ddq) {
    Vector applied = tau;
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
  Vector a1;
  for (int i = 0; i < kSteps; ++i) {
    const double t = i * h;
    acceleration(t, x.q, x.dq, a1);
    runge_kutta_step(
        h, a1,
        [&](double after, const Vector& q, const Vector& dq, Vector& ddq) {
          acceleration(t + after, q, dq, ddq);
        },
        x.q, x.dq);
  }
  return x;
}

}  // namespace faultline
