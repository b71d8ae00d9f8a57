// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/robot/fast_dynamics.hpp"
#include "lib/simulate/extra_friction.hpp"
#include "lib/simulate/fault_event.hpp"
#include "lib/simulate/gears.hpp"

namespace faultline {

/// Stiff ends of travel: a spring and damper beyond each end.
struct JointStops {
  std::vector<double> low{};  ///< rad or m, one number for each joint; empty: no stops
  std::vector<double> high{};
  double frequency_rad_s = 200.0;  ///< natural frequency of the joint's inertia on the stop's spring
  double damping = 0.5;            ///< damping ratio
};

/// Properties of a machine beyond rigid links with the friction of their model.
struct MachineSpec {
  GearSpec gears{};
  StickSlipSpec stick_slip{};
  WarmUpSpec warm_up{};
};

/// The mechanics of the simulated robot: its motion under a commanded torque, with the faults that act on the
/// mechanics. Integrates with Runge-Kutta of fourth order in sub-steps short enough for the stiffness of
/// friction, stops and gears.
class Plant {
 public:
  /// `machine` must fit the robot. Throws Error(usage) if the stops do not.
  Plant(const Robot& robot, const JointStops& stops, const std::vector<SimulatedFault>& faults,
        double max_step_s, const MachineSpec& machine = {});

  JointVector q, dq;  ///< of the links

  /// Starts motors and links at `speed` and the motors at `position`, with gear springs as loaded by weight.
  void start(const JointVector& position, const JointVector& speed);
  /// Integrates from `from` to `to` seconds under a constant commanded torque; faults begin and end at their
  /// exact times. Evaluates the warm-up of the friction at the middle of the interval.
  void advance(double from, double to, const JointVector& tau);

  /// Position and speed of the motors, which the encoders measure; with rigid gears those of the links.
  const JointVector& motor_q() const { return geared_ ? geared_->q : q; }
  const JointVector& motor_dq() const { return geared_ ? geared_->dq : dq; }

 private:
  /// The motors' side of a plant with compliant gears; a motor without a spring moves with its link.
  struct Geared {
    Gears gears;
    FastDynamics drives;  ///< the whole chain; used for the friction and ripple of the motors
    JointVector q{}, dq{};
  };
  using Bodies = FastDynamics::BodiesAt;
  /// Positions or velocities of the links, followed by those of the motors.
  using BothSides = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2 * kMaxJoints, 1>;

  void set_stops(const JointStops& stops);
  void enter(double now);
  void choose_steps(Chain& chain);
  double safe_step(const JointVector& rate, const JointVector& ddq) const;
  void impact(unsigned newly_locked);
  /// Advances the state `at`, `rate` by `length` seconds, the links alone or both sides: `bodies_of(at,
  /// rate)` returns the bodies, `acceleration(bodies, at, rate, out)` writes the acceleration. Where friction
  /// requires short steps, the bodies move in longer ones.
  template <typename Vector, typename BodiesOf, typename Acceleration>
  void integrate(double length, const BodiesOf& bodies_of, const Acceleration& acceleration, Vector& at,
                 Vector& rate) const;
  void integrate_rigid(double length, const JointVector& tau);
  void accelerate(const Bodies& bodies, const JointVector& at, const JointVector& rate,
                  const JointVector& tau, JointVector& out) const;
  void integrate_geared(double length, const JointVector& tau);
  void accelerate_geared(const Bodies& bodies, const BothSides& at, const BothSides& rate,
                         const JointVector& tau, BothSides& out) const;
  bool is_beyond_stop(int j, double at) const { return at > stop_high_[j] || at < stop_low_[j]; }
  double stop_torque(int j, double at, double rate) const;
  unsigned springs() const { return geared_ ? geared_->gears.springs() : 0u; }

  Chain healthy_;
  std::vector<SimulatedFault> faults_;
  std::vector<double> changes_;  ///< onsets and ends, ascending
  std::size_t next_change_ = 0;
  JointVector stop_low_, stop_high_, stop_stiffness_, stop_damping_;
  double max_step_ = 0.001;

  FastDynamics dynamics_;  ///< of the links and of all that is rigidly joined to them
  std::optional<Geared> geared_;
  ExtraFriction extra_friction_;
  JointVector gain_;          ///< factor of acting faults on the torque of the drives
  JointVector external_;      ///< added torque on the links
  JointVector drive_offset_;  ///< added torque of drives with springs
  bool altered_ = false;      ///< whether a fault acts, or a work piece is carried
  unsigned locked_ = 0;
  double step_ = 0.001;          ///< sub-step near rest, with stiff friction, s
  double sliding_step_ = 0.001;  ///< sub-step otherwise, s
};

}  // namespace faultline
