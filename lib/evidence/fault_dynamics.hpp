// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "lib/evidence/motion_model.hpp"
#include "lib/evidence/small_inverse.hpp"
#include "lib/robot/fast_dynamics.hpp"

namespace faultline {

/// Steps up to this long are short: one midpoint step, with a transition matrix from the friction slope.
inline constexpr double kShortStep_s = 0.004;
/// Steps up to this long take their transition matrix from the friction slope, longer ones by differences.
inline constexpr double kAnalyticStep_s = 0.012;
inline constexpr double kLongestSubstep_s = 0.005;

/// Joint accelerations with what a covariance needs besides.
struct Acceleration {
  JointArray value;
  JointSquare inverse_inertia;  ///< zero in the row and column of a locked joint
  JointArray friction_slope;    ///< dF/d(dq)
  double stiffness = 0.0;       ///< 1/s: how fast friction can stop a joint at most
  JointArray
      size_torque[2];  ///< generalised torque a unit of each fault size adds, where that is one joint's
};

/// The equations of motion under a hypothesis; without one, those of the healthy robot.
class FaultDynamics {
 public:
  explicit FaultDynamics(const MotionModel& model);

  int joints() const { return joints_; }
  /// Accelerations at (q, dq) with drive torque `torque`, `sizes` being the fault's size. `hypothesis` may be
  /// null.
  Acceleration evaluate(const double* q, const double* dq, const double* torque, const Hypothesis* hypothesis,
                        const double* sizes) const;
  /// Integrates q and dq in place over dt under a constant torque: the midpoint rule for short steps, else
  /// Runge-Kutta with substeps of at most 5 ms; linearly implicit where friction is stiff.
  /// Returns the accelerations at the middle of the step (short) or its start (long).
  Acceleration integrate(double* q, double* dq, const double* torque, double dt, const Hypothesis* hypothesis,
                         const double* sizes) const;
  /// The same by the midpoint rule with substeps of about 25 ms where friction allows: for derivatives, which
  /// bear the coarseness.
  void integrate_coarsely(double* q, double* dq, const double* torque, double dt,
                          const Hypothesis* hypothesis, const double* sizes) const;
  /// Change of velocity when joint j is stopped at once by a torque on that joint alone.
  JointArray stopping_impulse(const double* q, const double* dq, int j) const;

 private:
  void midpoint_step(double* q, double* dq, const Acceleration& start, const double* torque, double h,
                     const Hypothesis* hypothesis, const double* sizes, Acceleration* middle) const;
  void implicit_step(double* q, double* dq, const Acceleration& at, double h) const;
  void runge_kutta_step(double* q, double* dq, const double* torque, double h, const Hypothesis* hypothesis,
                        const double* sizes) const;

  const MotionModel& model_;
  FastDynamics healthy_;
  FastDynamics unit_payload_;  ///< the chain with 1 kg more at its tip
  int joints_;
};

}  // namespace faultline
