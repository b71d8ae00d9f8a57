// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/robot/fast_dynamics.hpp"
#include "lib/simulate/fault_event.hpp"

namespace faultline {

/// Stiff ends of travel: a spring and damper beyond each end.
struct JointStops {
  std::vector<double> low{};  ///< rad or m, one each a joint; empty: no stops
  std::vector<double> high{};
  double frequency_rad_s = 200.0;  ///< of the joint's inertia on the stop's spring
  double damping = 0.5;            ///< ratio
};

/// The robot as it is at a time: its motion under a commanded torque, with the faults that act on the
/// mechanics. Integrates with Runge-Kutta of fourth order in sub-steps short enough for the friction's
/// stiffness.
class Plant {
 public:
  Plant(const Robot& robot, const JointStops& stops, const std::vector<FaultEvent>& faults,
        double max_step_s);

  JointVector<double> q, dq;

  /// Moves from `from` to `to` seconds under a constant commanded torque; faults that begin or end in between
  /// do so at their very moment.
  void advance(double from, double to, const JointVector<double>& tau);

 private:
  void set_stops(const JointStops& stops);
  void enter(double now);
  void choose_steps(Chain<double>& chain);
  double safe_step(const JointVector<double>& ddq) const;
  void impact();
  void integrate(double length, const JointVector<double>& tau);
  void accelerate(const JointVector<double>& at, const JointVector<double>& rate,
                  const JointVector<double>& tau, JointVector<double>& out) const;

  Chain<double> healthy_;
  std::vector<FaultEvent> faults_;
  std::vector<double> changes_;  ///< onsets and ends, ascending
  std::size_t next_change_ = 0;
  JointVector<double> stop_low_, stop_high_, stop_stiffness_, stop_damping_;
  double max_step_ = 0.001;

  FastDynamics dynamics_;
  JointVector<double> gain_;      ///< share of the torque that arrives
  JointVector<double> external_;  ///< added torque
  bool altered_ = false;          ///< gain_ or external_ matter
  unsigned locked_ = 0;
  double step_ = 0.001;          ///< where friction is stiff
  double sliding_step_ = 0.001;  ///< elsewhere
};

}  // namespace faultline
