// SPDX-License-Identifier: MIT
#include "lib/residual/twin_transitions.hpp"

#include <algorithm>

#include "lib/core/random.hpp"
#include "lib/residual/physics_step.hpp"
#include "lib/residual/transition_reservoir.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

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
                             int count, const TwinPatternOptions& options) {
  const VectorXd q_half = half_range(logged.q), dq_half = half_range(logged.dq),
                 tau_half = half_range(logged.mean_tau);
  const FastDynamics robot(chain);
  Random random(options.seed);
  TransitionReservoir pool(std::max(count, 1), options.seed);
  Transitions one = logged;  // column 0 holds the current transition
  for (int i = 0; i < count; ++i) {
    const int origin = static_cast<int>(random.below(logged.count()));
    one.duration[0] = shape.step_s;
    one.q.col(0) = scattered(logged.q.col(origin), q_half, options.position_spread, random);
    one.dq.col(0) = scattered(logged.dq.col(origin), dq_half, options.velocity_spread, random);
    one.mean_tau.col(0) = scattered(logged.mean_tau.col(origin), tau_half, options.torque_spread, random);
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
