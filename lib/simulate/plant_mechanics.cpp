// SPDX-License-Identifier: MIT
// What a plant is from one change to the next: faults that act, stops, steps. Its motion is in plant.cpp.
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "lib/core/error.hpp"
#include "lib/core/random.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/robot/payload.hpp"
#include "lib/simulate/plant.hpp"

namespace faultline {
namespace {

/// Largest rate x step that Runge-Kutta of fourth order follows with a few per cent (it is stable to 2.78).
constexpr double kRateTimesStep = 1.0;
/// The same for a vibration that must neither grow nor fade: it loses 4e-5 of its amplitude a period.
constexpr double kVibrationTimesStep = 0.25;

/// Steps a stiff friction may ask for within max_step_s.
constexpr double kMostSubSteps = 10.0;
constexpr double kLively = 10.0;  // rad/s^2 or m/s^2

/// Largest diagonal of M^-1 for each joint over some postures.
JointVector mobility(const FastDynamics& dynamics) {
  const int n = dynamics.joints();
  Random random(1);
  JointVector most = JointVector::Zero(n), q(n), bias;
  const JointVector rest = JointVector::Zero(n);
  JointMatrix inertia;
  for (int k = 0; k < 16; ++k) {
    for (int i = 0; i < n; ++i) q[i] = k ? random.uniform(-3.0, 3.0) : 0.0;
    dynamics.inertia_and_bias(q, rest, inertia, bias);
    const JointMatrix inverse = inertia.inverse();
    most = most.cwiseMax(inverse.diagonal());
  }
  return most;
}

/// What a drive usually has to give: the weight and a lively acceleration at q = 0.
JointVector usual_torque(const Chain& chain) {
  const JointVector zero = JointVector::Zero(chain.joints());
  return kLively * inertia_matrix(chain, zero).diagonal() + gravity_torque(chain, zero).cwiseAbs();
}

}  // namespace

Plant::Plant(const Robot& robot, const JointStops& stops, const std::vector<SimulatedFault>& faults,
             double max_step_s, const MachineSpec& machine)
    : healthy_(with_motors(robot, machine.gears).chain),
      faults_(faults),
      max_step_(max_step_s),
      dynamics_(healthy_),
      extra_friction_(healthy_, machine.stick_slip, machine.warm_up) {
  for (const SimulatedFault& fault : faults_) {
    changes_.push_back(fault.onset_s);
    if (std::isfinite(fault.end_s)) changes_.push_back(fault.end_s);
  }
  std::sort(changes_.begin(), changes_.end());
  if (!stops.low.empty() || !stops.high.empty()) set_stops(stops);
  q = dq = JointVector::Zero(robot.joints());
  const Gears gears(healthy_, machine.gears);
  if (gears.springs() != 0u) geared_.emplace(Geared{gears, dynamics_, q, dq});
  enter(-1.0);
}

void Plant::set_stops(const JointStops& stops) {
  const int n = dynamics_.joints();
  if (static_cast<int>(stops.low.size()) != n || static_cast<int>(stops.high.size()) != n)
    throw Error(ErrorCode::usage, "limits.stop_low, stop_high",
                fmt::format("expected {} numbers in each", n));
  JointMatrix inertia;
  JointVector bias;
  const JointVector zero = JointVector::Zero(n);
  dynamics_.inertia_and_bias(zero, zero, inertia, bias);
  stop_low_ = Eigen::Map<const Eigen::VectorXd>(stops.low.data(), n);
  stop_high_ = Eigen::Map<const Eigen::VectorXd>(stops.high.data(), n);
  stop_stiffness_ = stops.frequency_rad_s * stops.frequency_rad_s * inertia.diagonal();
  stop_damping_ = 2.0 * stops.damping * stops.frequency_rad_s * inertia.diagonal();
}

/// The steps this moment's mechanics allow, near rest and sliding; raises friction widths that would ask for
/// more than kMostSubSteps.
void Plant::choose_steps(Chain& chain) {
  const JointVector links = mobility(FastDynamics(geared_ ? geared_->gears.link_side(chain) : chain));
  JointVector drives = links;
  for (int i = 0; i < chain.joints(); ++i)
    if (springs() >> i & 1u) drives[i] = 1.0 / geared_->gears.motor_inertia(i);
  const JointVector usual = usual_torque(chain);
  double sliding = 0.0, near_rest = 0.0;
  for (int i = 0; i < chain.joints(); ++i) {
    Friction f = extra_friction_.worst(i, chain.friction[i]);
    f.width = std::max(
        f.width, drives[i] * (f.coulomb + f.load * usual[i]) * max_step_ / (kRateTimesStep * kMostSubSteps));
    chain.friction[i].width = f.width;
    sliding = std::max(sliding, drives[i] * (f.viscous + std::abs(f.skew) + std::abs(f.bend) / f.bend_width));
    if (stop_low_.size() > 0) sliding = std::max(sliding, std::sqrt(links[i] * stop_stiffness_[i]));
    near_rest = std::max(near_rest, drives[i] * steepest(f, usual[i]));
  }
  for (const SharedDrive& f : chain.shared_drives) {
    const double mobile = f.along.cwiseAbs2().dot(Eigen::VectorXd(drives));
    near_rest = std::max(near_rest, mobile * (f.viscous + f.coulomb / f.width));
  }
  if (geared_)
    sliding = std::max({sliding, geared_->gears.damping_rate(links),
                        geared_->gears.vibration_rate(links) * kRateTimesStep / kVibrationTimesStep});
  const auto step_for = [&](double rate) {
    return rate > 0.0 ? std::min(max_step_, kRateTimesStep / rate) : max_step_;
  };
  sliding_step_ = step_for(sliding);
  step_ = std::min(sliding_step_, step_for(near_rest));
}

/// The mechanics of the moment `now`: which faults act, and the velocity that a joint just locked has lost.
void Plant::enter(double now) {
  const int n = healthy_.joints();
  Chain chain = healthy_;
  const unsigned was_locked = locked_;
  gain_ = JointVector::Ones(n);
  external_ = drive_offset_ = JointVector::Zero(n);
  locked_ = 0;
  altered_ = false;
  for (const SimulatedFault& fault : faults_) {
    if (now < fault.onset_s || now >= fault.end_s) continue;
    const int i = fault.joint - 1;
    altered_ = true;
    const MachineFault change = machine_fault(fault);
    gain_[i] *= change.torque_gain;
    external_[i] += change.external_torque;
    (springs() >> i & 1u ? drive_offset_ : external_)[i] += change.drive_offset;
    chain.friction[i].coulomb += change.coulomb;
    chain.friction[i].viscous += change.viscous;
    if (change.locks) locked_ |= 1u << i;
    if (change.payload != 0.0) chain = with_payload(chain, i, change.payload);
  }
  choose_steps(chain);
  dynamics_ = FastDynamics(geared_ ? geared_->gears.link_side(chain) : chain);
  if (geared_) geared_->drives = FastDynamics(chain);
  if (locked_ & ~was_locked) impact(locked_ & ~was_locked);
}

/// A joint locks: it stops at once, and the impulse of the lock changes the other joints' velocities so that
/// their momenta stay. Behind a spring the motor alone stops.
void Plant::impact(unsigned newly_locked) {
  const int n = healthy_.joints();
  if (newly_locked & ~springs()) {
    JointMatrix inertia;
    JointVector bias;
    dynamics_.inertia_and_bias(q, dq, inertia, bias);
    JointVector momenta = inertia * dq;
    solve_small(n, inertia.data(), momenta.data(), locked_ & ~springs());
    dq = momenta;
  }
  for (int i = 0; geared_ && i < n; ++i)
    geared_->dq[i] = !geared_->gears.has_spring(i) ? dq[i] : locked_ >> i & 1u ? 0.0 : geared_->dq[i];
}

}  // namespace faultline
