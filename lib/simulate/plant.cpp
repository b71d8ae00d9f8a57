// SPDX-License-Identifier: MIT
#include "lib/simulate/plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/robot/dynamics.hpp"
#include "lib/robot/payload.hpp"
#include "lib/robot/runge_kutta.hpp"
#include "lib/simulate/joint_list.hpp"
#include "lib/simulate/mobility.hpp"

namespace faultline {
namespace {

constexpr int kRestIterations = 100;  // each scales the error by weight's slope / spring stiffness

/// Largest product of rate and step that RK4 integrates to a few per cent (it is stable up to 2.78).
constexpr double kRateTimesStep = 1.0;
/// The same for an undamped vibration, whose amplitude then decays by only 4e-5 in a period.
constexpr double kVibrationTimesStep = 0.25;

/// Highest number of sub-steps in max_step_s that stiff friction may require.
constexpr double kMostSubSteps = 10.0;

/// Longest time, s, for which the bodies are those at its middle while stiff friction changes the velocities.
constexpr double kHeldBodies = 1e-3;
/// Sub-steps in that time above which holding the bodies costs less than moving them along.
constexpr double kHoldingPays = 3.0;

/// Returns a usual torque of each drive: gravity at q = 0 plus the torque for an acceleration of
/// 10 rad/s^2 or m/s^2.
JointVector usual_torque(const Chain& chain) {
  const JointVector zero = JointVector::Zero(chain.joints());
  const JointVector weight = rigid_body_torque(chain, zero, zero, zero, chain.gravity);
  return 10.0 * inertia_matrix(chain, zero).diagonal() + weight.cwiseAbs();
}

/// Returns the longest of equal parts of `length` that are at most `longest`.
double equal_part(double length, double longest) {
  return length / std::max(1.0, std::ceil(length / longest - 1e-9));
}

/// Advances a state by `length` seconds in sub-steps of at most `longest`. `acceleration(q, dq, ddq)` writes
/// the acceleration.
template <typename Vector, typename Acceleration>
void sub_steps(double length, double longest, const Acceleration& acceleration, Vector& q, Vector& dq) {
  const double count = std::max(1.0, std::ceil(length / longest - 1e-9));
  Vector a1(q.size());
  for (int k = 0; k < static_cast<int>(count); ++k) {
    acceleration(q, dq, a1);
    runge_kutta_step(
        length / count, a1,
        [&](double, const Vector& at, const Vector& rate, Vector& out) { acceleration(at, rate, out); }, q,
        dq);
  }
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
    bad_value("limits.stop_low, stop_high", fmt::format("expected {} numbers in each", n));
  JointMatrix inertia;
  JointVector bias;
  const JointVector zero = JointVector::Zero(n);
  dynamics_.inertia_and_bias(zero, zero, inertia, bias);
  stop_low_ = Eigen::Map<const Eigen::VectorXd>(stops.low.data(), n);
  stop_high_ = Eigen::Map<const Eigen::VectorXd>(stops.high.data(), n);
  stop_stiffness_ = stops.frequency_rad_s * stops.frequency_rad_s * inertia.diagonal();
  stop_damping_ = 2.0 * stops.damping * stops.frequency_rad_s * inertia.diagonal();
}

/// Chooses the steps for the current mechanics, near rest and sliding; widens friction that would require
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
    sliding = std::max(sliding, drives[i] * sliding_slope(f));
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

/// Sets the mechanics at the time `now`: acting faults, and the velocities after a joint has locked.
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
    const int i = fault.joint.index();
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

/// Stops newly locked joints at once; the impulse of the lock changes the other joints' velocities so that
/// their momenta are conserved. Of a joint with a spring only the motor stops.
void Plant::impact(unsigned newly_locked) {
  const int n = healthy_.joints();
  if (newly_locked & ~springs()) {
    JointMatrix inertia;
    JointVector bias;
    dynamics_.inertia_and_bias(q, dq, inertia, bias);
    JointVector momenta = inertia * dq;
    const unsigned fixed = locked_ & ~springs();
    factor_small(n, inertia.data(), fixed);
    solve_factored(n, inertia.data(), momenta.data(), fixed);
    dq = momenta;
  }
  for (int i = 0; geared_ && i < n; ++i)
    geared_->dq[i] = !geared_->gears.has_spring(i) ? dq[i] : locked_ >> i & 1u ? 0.0 : geared_->dq[i];
}

// The motion between two changes; with compliant gears, motors and links each have a state of their own.

/// Returns the longest safe step from a state in which the drives have the velocity `rate` and the
/// acceleration `ddq`: friction is stiff only if a velocity may pass near zero within the step.
double Plant::safe_step(const JointVector& rate, const JointVector& ddq) const {
  if (step_ == sliding_step_) return step_;
  const std::vector<Friction>& friction = (geared_ ? geared_->drives : dynamics_).chain().friction;
  for (int i = 0; i < rate.size(); ++i) {
    const Friction& f = friction[i];
    if (f.coulomb != 0.0 && std::abs(rate[i]) < 8.0 * f.width + 2.0 * sliding_step_ * std::abs(ddq[i]))
      return step_;
  }
  return sliding_step_;
}

void Plant::advance(double from, double to, const JointVector& tau) {
  extra_friction_.set_time(0.5 * (from + to));
  const auto move_on = [&](double length) {
    return geared_ ? integrate_geared(length, tau) : integrate_rigid(length, tau);
  };
  double now = from;
  while (next_change_ < changes_.size() && changes_[next_change_] <= to) {
    const double change = std::max(changes_[next_change_++], now);
    move_on(change - now);
    now = change;
    enter(now);
  }
  move_on(to - now);
}

/// Returns the torque of the end stop, which pushes but never pulls.
double Plant::stop_torque(int j, double at, double rate) const {
  const bool high = at > stop_high_[j];
  const double beyond = at - (high ? stop_high_[j] : stop_low_[j]);
  const double push = stop_stiffness_[j] * beyond + stop_damping_[j] * rate;
  return high ? std::max(push, 0.0) : std::min(push, 0.0);
}

void Plant::accelerate(const Bodies& bodies, const JointVector& at, const JointVector& rate,
                       const JointVector& tau, JointVector& out) const {
  const bool stops = stop_low_.size() > 0, extra = extra_friction_.any();
  if (!altered_ && !stops && !extra) return dynamics_.acceleration(bodies, at, rate, tau, out);
  const int n = dynamics_.joints();
  JointVector net(n);
  for (int i = 0; i < n; ++i) {
    net[i] = gain_[i] * tau[i] + external_[i];
    if (extra) net[i] -= extra_friction_.torque(i, rate[i], dynamics_.chain().friction[i]);
    if (stops && is_beyond_stop(i, at[i])) net[i] -= stop_torque(i, at[i], rate[i]);
  }
  dynamics_.acceleration(bodies, at, rate, net, out);
}

template <typename Vector, typename BodiesOf, typename Acceleration>
void Plant::integrate(double length, const BodiesOf& bodies_of, const Acceleration& acceleration, Vector& at,
                      Vector& rate) const {
  const auto n = q.size();
  Vector a1(at.size());
  while (length > 1e-12) {
    const Bodies here = bodies_of(at, rate);
    acceleration(here, at, rate, a1);
    const double longest = safe_step(rate.tail(n), a1.tail(n));
    const double held = equal_part(length, std::min(sliding_step_, kHeldBodies));
    if (held > kHoldingPays * longest) {
      const auto with = [&](const Bodies& bodies) {
        return [&](const Vector& x, const Vector& v, Vector& out) { acceleration(bodies, x, v, out); };
      };
      Vector middle = at, middle_rate = rate;
      sub_steps(0.5 * held, longest, with(here), middle, middle_rate);
      const Bodies between = bodies_of(middle, middle_rate);
      sub_steps(held, longest, with(between), at, rate);
      length -= held;
    } else {
      const double h = equal_part(length, longest);
      runge_kutta_step(
          h, a1,
          [&](double, const Vector& x, const Vector& v, Vector& out) {
            acceleration(bodies_of(x, v), x, v, out);
          },
          at, rate);
      length -= h;
    }
  }
}

void Plant::integrate_rigid(double length, const JointVector& tau) {
  integrate(
      length,
      [&](const JointVector& at, const JointVector& rate) { return dynamics_.bodies_at(at, rate, locked_); },
      [&](const Bodies& bodies, const JointVector& at, const JointVector& rate, JointVector& out) {
        accelerate(bodies, at, rate, tau, out);
      },
      q, dq);
}

void Plant::start(const JointVector& position, const JointVector& speed) {
  q = position;
  dq = speed;
  if (!geared_) return;
  geared_->q = position;
  geared_->dq = speed;
  const JointVector rest = JointVector::Zero(q.size());
  JointMatrix inertia;
  JointVector weight;
  for (int k = 0; k < kRestIterations; ++k) {
    dynamics_.inertia_and_bias(q, rest, inertia, weight);
    for (int i = 0; i < q.size(); ++i)
      if (geared_->gears.has_spring(i)) q[i] = position[i] - geared_->gears.twist_under(i, weight[i]);
  }
}

/// A joint with a spring: J th'' = acting torque - drag - gear torque for its motor, and the gear torque
/// drives its link. A rigid joint: as without gears; its motor moves with its link.
void Plant::accelerate_geared(const Bodies& bodies, const BothSides& at, const BothSides& rate,
                              const JointVector& tau, BothSides& out) const {
  const int n = dynamics_.joints();
  const Gears& gears = geared_->gears;
  const JointVector link = at.head(n), link_rate = rate.head(n), motor = at.tail(n),
                    motor_rate = rate.tail(n);
  const std::vector<Friction>& friction = geared_->drives.chain().friction;
  JointVector arrives(n), drag(n), net(n), ddq(n);
  for (int i = 0; i < n; ++i)
    arrives[i] = gain_[i] * tau[i] + drive_offset_[i] - extra_friction_.torque(i, motor_rate[i], friction[i]);
  geared_->drives.drag(motor, motor_rate, arrives, drag);
  for (int i = 0; i < n; ++i) {
    const bool spring = gears.has_spring(i);
    const double gear =
        spring ? gears.torque(i, motor[i] - link[i], motor_rate[i] - link_rate[i]) : arrives[i];
    net[i] = gear + external_[i];
    if (stop_low_.size() > 0 && is_beyond_stop(i, link[i])) net[i] -= stop_torque(i, link[i], link_rate[i]);
    if (spring) out[n + i] = locked_ >> i & 1u ? 0.0 : (arrives[i] - drag[i] - gear) / gears.motor_inertia(i);
  }
  dynamics_.acceleration(bodies, link, link_rate, net, ddq);
  out.head(n) = ddq;
  for (int i = 0; i < n; ++i)
    if (!gears.has_spring(i)) out[n + i] = ddq[i];
}

void Plant::integrate_geared(double length, const JointVector& tau) {
  const auto n = q.size();
  BothSides at(2 * n), rate(2 * n);
  at << q, geared_->q;
  rate << dq, geared_->dq;
  integrate(
      length,
      [&](const BothSides& x, const BothSides& v) {
        return dynamics_.bodies_at(x.head(n), v.head(n), locked_ & ~springs());
      },
      [&](const Bodies& bodies, const BothSides& x, const BothSides& v, BothSides& out) {
        accelerate_geared(bodies, x, v, tau, out);
      },
      at, rate);
  q = at.head(n);
  dq = rate.head(n);
  geared_->q = at.tail(n);
  geared_->dq = rate.tail(n);
}

}  // namespace faultline
