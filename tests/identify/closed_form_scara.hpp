// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

#include "lib/core/random.hpp"
#include "lib/log/log.hpp"

namespace faultline::testing {

/// A three-axis SCARA by its closed form, apart from the library's dynamics: M11 = a + b + 2 c cos q2,
/// M12 = b + c cos q2, M22 = b, M33 = m3, smooth Coulomb friction.
struct ClosedFormScara {
  using Triple = std::array<double, 3>;
  struct State {
    Triple q, dq;
  };

  double m1 = 1.0, m2 = 0.8, m3 = 0.5, l1 = 1.0, l2 = 0.8;
  double payload = 0.0;    ///< kg at the tip
  double on_link_2 = 0.0;  ///< kg at the end of link 2, which the slide does not lift
  Triple fv = {0.5, 0.3, 2.0}, fc = {0.6, 0.4, 1.0};
  double width = 0.02;
  Triple stribeck = {0, 0, 0};  ///< Coulomb friction near rest beyond fc, gone at a few stribeck_speed
  double stribeck_speed = 0.3;
  Triple skew = {0, 0, 0};    ///< friction that grows with speed in one direction and falls in the other
  Triple load = {0, 0, 0};    ///< share of the torque carried that friction takes
  Triple ripple = {0, 0, 0};  ///< amplitude of a torque that repeats with the position
  Triple ripple_rate = {40, 25, 314.16};    ///< 1/rad, 1/m
  bool is_locked = false;                   ///< joint 2 does not move
  double shared_fv = 0.0, shared_fc = 0.0;  ///< friction of a drive that turns with joints 1 and 2 together

  double carried() const { return m3 + payload; }
  double a() const { return l1 * l1 * (m1 / 3 + m2 + carried() + on_link_2); }
  double b() const { return l2 * l2 * (m2 / 3 + carried() + on_link_2); }
  double c() const { return l1 * l2 * (m2 / 2 + carried() + on_link_2); }

  Triple acceleration(const State& x, const Triple& tau) const {
    const double cos2 = std::cos(x.q[1]), bend = c() * std::sin(x.q[1]);
    const double both = x.dq[0] + x.dq[1], drag = shared_fv * both + shared_fc * std::tanh(both / width);
    Triple force;
    for (int j = 0; j < 3; ++j) {
      const double slow = std::exp(-std::pow(x.dq[j] / stribeck_speed, 2)), sign = std::tanh(x.dq[j] / width);
      force[j] = tau[j] - fv[j] * x.dq[j] - (fc[j] + stribeck[j] * slow) * sign -
                 skew[j] * std::abs(x.dq[j]) - ripple[j] * std::sin(ripple_rate[j] * x.q[j] + 0.6);
      if (j < 2) force[j] -= drag;
      force[j] /= 1.0 + load[j] * sign * (force[j] > 0.0 ? 1.0 : -1.0);
    }
    force[0] += bend * (2 * x.dq[0] * x.dq[1] + x.dq[1] * x.dq[1]);
    force[1] -= bend * x.dq[0] * x.dq[0];
    const double m11 = a() + b() + 2 * c() * cos2, m12 = b() + c() * cos2, m22 = b();
    const double slide = force[2] / carried() - 9.81;
    if (is_locked) return {force[0] / m11, 0.0, slide};
    const double determinant = m11 * m22 - m12 * m12;
    return {(m22 * force[0] - m12 * force[1]) / determinant, (m11 * force[1] - m12 * force[0]) / determinant,
            slide};
  }

  void step(State& x, const Triple& tau, double h) const {
    const auto moved = [&](const State& by, double dt) {
      State out = x;
      for (int j = 0; j < 3; ++j) out.q[j] += dt * by.q[j], out.dq[j] += dt * by.dq[j];
      return out;
    };
    const auto slope = [&](const State& at) { return State{at.dq, acceleration(at, tau)}; };
    const State k1 = slope(x), k2 = slope(moved(k1, h / 2)), k3 = slope(moved(k2, h / 2)),
                k4 = slope(moved(k3, h));
    for (int j = 0; j < 3; ++j) {
      x.q[j] += h / 6 * (k1.q[j] + 2 * k2.q[j] + 2 * k3.q[j] + k4.q[j]);
      x.dq[j] += h / 6 * (k1.dq[j] + 2 * k2.dq[j] + 2 * k3.dq[j] + k4.dq[j]);
    }
  }
};

struct ClosedFormRun {
  double duration_s = 4.0, period_s = 0.005;
  ClosedFormScara::Triple reach = {1.2, 1.4, 0.15};  ///< amplitude of the motion; 0: the joint rests
  double q_noise = 1e-4, dq_noise = 5e-3;
  ClosedFormScara::Triple torque_gain = {1, 1, 1};  ///< true torque of each one logged
  double clips_from_s = 1e9;                        ///< from then on the drives give no more than `clip`
  std::array<double, 3> clip = {1e9, 1e9, 1e9};     ///< N m or N
  double locks_from_s = 1e9;                        ///< from then on joint 2 is locked
  double loaded_from_s = 1e9, load_kg = 0.0;        ///< from then on link 2 carries so much more
  double carries_from_s = 1e9, carries_to_s = 1e9, piece_kg = 0.0;  ///< when the tip carries a work piece
  std::uint64_t seed = 1;
  double bandwidth = 12.0;  ///< of the controller, rad/s
};

/// Sums of two sines followed by PD with the torque held over a sample; white noise on q and dq.
inline Log simulate_closed_form(ClosedFormScara robot, const ClosedFormRun& run) {
  const double bandwidth = run.bandwidth;
  Random random(run.seed);
  std::array<std::array<double, 3>, 3> phase;
  for (auto& of : phase)
    for (double& p : of) p = random.uniform(0.0, 6.28);
  const auto reference = [&](double t, int j, double& q, double& dq) {
    const double w = 3.0 + 0.7 * j;
    q = run.reach[j] * (0.7 * std::sin(w * t + phase[j][0]) + 0.3 * std::sin(2.3 * w * t + phase[j][1]));
    dq =
        run.reach[j] * w * (0.7 * std::cos(w * t + phase[j][0]) + 0.69 * std::cos(2.3 * w * t + phase[j][1]));
  };
  ClosedFormScara::State x{};
  for (int j = 0; j < 3; ++j) reference(0.0, j, x.q[j], x.dq[j]);
  const double payload = robot.payload;
  const double inertia[] = {robot.a() + robot.b(), robot.b(), robot.carried()};
  Log log;
  log.q.resize(3);
  log.dq.resize(3);
  log.tau.resize(3);
  const int rows = static_cast<int>(std::lround(run.duration_s / run.period_s));
  const int pieces = static_cast<int>(std::ceil(run.period_s / 0.0005));
  for (int k = 0; k < rows; ++k) {
    ClosedFormScara::Triple tau;
    if (k * run.period_s >= run.locks_from_s) robot.is_locked = true, x.dq[1] = 0.0;
    if (k * run.period_s >= run.loaded_from_s) robot.on_link_2 = run.load_kg;
    const bool carries = k * run.period_s >= run.carries_from_s && k * run.period_s < run.carries_to_s;
    robot.payload = payload + (carries ? run.piece_kg : 0.0);
    log.time.push_back(k * run.period_s);
    for (int j = 0; j < 3; ++j) {
      double q = 0.0, dq = 0.0;
      reference(k * run.period_s, j, q, dq);
      tau[j] = inertia[j] * (bandwidth * bandwidth * (q - x.q[j]) + 2 * bandwidth * (dq - x.dq[j])) +
               (j == 2 ? robot.carried() * 9.81 : 0.0);
      log.q[j].push_back(x.q[j] + run.q_noise * random.normal());
      log.dq[j].push_back(x.dq[j] + run.dq_noise * random.normal());
      log.tau[j].push_back(tau[j] / run.torque_gain[j]);
      if (k * run.period_s >= run.clips_from_s)
        tau[j] = std::max(-run.clip[j], std::min(run.clip[j], tau[j]));
    }
    for (int i = 0; i < pieces; ++i) robot.step(x, tau, run.period_s / pieces);
  }
  return log;
}

}  // namespace faultline::testing
