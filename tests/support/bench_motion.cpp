// SPDX-License-Identifier: MIT
#include "tests/support/bench_motion.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/random.hpp"
#include "lib/residual/physics_step.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

using Vector = JointVector;

struct Wanted {
  Vector q, dq, ddq;
};

/// Quintic moves between random points, one after the other.
class Motion {
 public:
  Motion(const Robot& robot, std::uint64_t seed) : robot_(robot), random_(seed), from_(draw()), to_(from_) {}

  Wanted at(double t) {
    while (t >= start_ + move_ + dwell_) {
      start_ += move_ + dwell_;
      from_ = to_;
      to_ = draw();
      move_ = random_.uniform(1.2, 1.8);
      dwell_ = random_.uniform(0.0, 0.4);
    }
    const double s = std::min((t - start_) / move_, 1.0), s2 = s * s;
    const Vector way = to_ - from_;
    return {from_ + way * (s2 * s * (10.0 - 15.0 * s + 6.0 * s2)),
            way * (s2 * (30.0 - 60.0 * s + 30.0 * s2) / move_),
            way * (s * (60.0 - 180.0 * s + 120.0 * s2) / (move_ * move_))};
  }

 private:
  Vector draw() {
    Vector q(robot_.joints());
    for (int j = 0; j < robot_.joints(); ++j)
      q[j] = robot_.chain.geometry[j].kind == AxisKind::revolute ? random_.uniform(-2.0, 2.0)
                                                                 : random_.uniform(-0.35, 0.05);
    return q;
  }

  const Robot& robot_;
  Random random_;
  Vector from_, to_;
  double start_ = 0.0, move_ = 0.01, dwell_ = 0.0;
};

void log_row(Log& log, double t, const JointState& x, const Vector& tau) {
  log.time.push_back(t);
  for (int j = 0; j < tau.size(); ++j) {
    log.q[j].push_back(x.q[j]);
    log.dq[j].push_back(x.dq[j]);
    log.tau[j].push_back(tau[j]);
  }
}

void add_noise(std::vector<double>& signal, double share, Random& random) {
  const auto [low, high] = std::minmax_element(signal.begin(), signal.end());
  const double sigma = share * 0.5 * (*high - *low);
  for (double& value : signal) value += sigma * random.normal();
}

}  // namespace

Log bench_log(const Robot& robot, const BenchMotion& options) {
  const FastDynamics dynamics(robot.chain);
  Motion motion(robot, options.seed);
  Random random = Random::stream(options.seed, 1);
  const int n = robot.joints(), rows = static_cast<int>(options.duration_s / options.log_period_s);
  Log log;
  log.q.resize(n);
  log.dq.resize(n);
  log.tau.resize(n);
  JointState x{motion.at(0.0).q, Vector::Zero(n)};
  const double h = options.log_period_s / options.control_steps;
  for (int row = 0; row < rows; ++row) {
    for (int control = 0; control < options.control_steps; ++control) {
      const double t = row * options.log_period_s + control * h;
      const Wanted wanted = motion.at(t);
      const Vector asked = inverse_dynamics(robot.chain, x.q, x.dq,
                                            wanted.ddq + 8.0 * (wanted.dq - x.dq) + 16.0 * (wanted.q - x.q));
      if (control == 0) log_row(log, t, x, asked);
      Vector applied = asked;
      if (options.free_joint > 0 && t >= options.fault_s) applied[options.free_joint - 1] = 0.0;
      x = physics_step(dynamics, x, applied, h);
    }
  }
  for (int j = 0; j < n; ++j) {
    add_noise(log.q[j], options.noise, random);
    add_noise(log.dq[j], options.noise, random);
  }
  return log;
}

}  // namespace faultline
