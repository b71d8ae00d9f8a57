// SPDX-License-Identifier: MIT
#include "lib/residual/twin_transitions.hpp"

#include <algorithm>
#include <cstdint>

#include "lib/core/random.hpp"
#include "lib/residual/physics_step.hpp"
#include "lib/residual/transition_reservoir.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Standard deviations that are added to the logged starts, as shares of half their range.
constexpr double kMotionSpread = 0.3, kTorqueSpread = 0.4;
constexpr std::uint64_t kPatternSeed = 1;

VectorXd half_range(const MatrixXd& values) {
  return 0.5 * (values.rowwise().maxCoeff() - values.rowwise().minCoeff());
}

VectorXd scattered(const VectorXd& centre, const VectorXd& half, double spread, Random& random) {
  VectorXd out = centre;
  for (Eigen::Index j = 0; j < out.size(); ++j) out[j] += spread * half[j] * random.normal();
  return out;
}

}  // namespace

Transitions twin_transitions(const Transitions& logged, const TransitionShape& shape, const Chain& chain,
                             int count) {
  const VectorXd q_half = half_range(logged.q), dq_half = half_range(logged.dq),
                 tau_half = half_range(logged.mean_tau);
  const FastDynamics robot(chain);
  Random random(kPatternSeed);
  TransitionReservoir pool(std::max(count, 1), kPatternSeed);
  Transitions one = logged;  // column 0 holds the current transition
  for (int i = 0; i < count; ++i) {
    const int origin = static_cast<int>(random.below(logged.count()));
    one.duration[0] = shape.step_s;
    one.q.col(0) = scattered(logged.q.col(origin), q_half, kMotionSpread, random);
    one.dq.col(0) = scattered(logged.dq.col(origin), dq_half, kMotionSpread, random);
    one.mean_tau.col(0) = scattered(logged.mean_tau.col(origin), tau_half, kTorqueSpread, random);
    one.tau.col(0) = one.mean_tau.col(0) + logged.tau.col(origin) - logged.mean_tau.col(origin);
    const JointState end =
        physics_step(robot, {one.q.col(0), one.dq.col(0)}, one.mean_tau.col(0), shape.step_s);
    if (!end.q.allFinite() || !end.dq.allFinite()) continue;
    one.next_q.col(0) = end.q;
    one.next_dq.col(0) = end.dq;
    pool.offer(one, 0);
  }
  return pool.drawn();
}

}  // namespace faultline
