// SPDX-License-Identifier: MIT
#include "lib/identify/days/healthy_looks.hpp"

#include <algorithm>

#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTopSpeed = 0.999;  // quantile of a joint's speed
// Bounds of the share of repeated positions, whose logarithm is the price of a stuck encoder.
constexpr double kFewestRepeats = 1e-3, kMostRepeats = 0.999;

}  // namespace

BalanceModel with_looks(const std::vector<HealthyDay>& days, BalanceModel m) {
  const int n = m.joints();
  std::vector<VectorXd> q, dq;
  m.q_low = VectorXd::Constant(n, 1e300);
  m.q_high = -m.q_low;
  m.top_speed = m.torque_rms = m.repeat_share = VectorXd::Zero(n);
  m.longest_repeat = Eigen::VectorXi::Zero(n);
  double rows = 0.0;
  for (const HealthyDay& day : days) {
    q.push_back(day.log.q_noise);
    dq.push_back(day.log.dq.rows() > 0 ? day.log.dq_noise : day.log.q_noise);
    m.q_low = m.q_low.cwiseMin(day.log.q.colwise().minCoeff().transpose());
    m.q_high = m.q_high.cwiseMax(day.log.q.colwise().maxCoeff().transpose());
    m.torque_rms += day.log.tau.cwiseAbs2().colwise().sum().transpose();
    rows += day.log.rows();
    const MatrixXd speed = fused_velocity(day.log, m.setting).cwiseAbs();
    for (int j = 0; j < n; ++j) {
      std::vector<double> v(speed.col(j).data(), speed.col(j).data() + speed.rows());
      m.top_speed[j] = std::max(m.top_speed[j], upper_quantile(std::move(v), kTopSpeed));
      int run = 0, same = 0;
      for (int k = 1; k < day.log.rows(); ++k) {
        run = day.log.q(k, j) == day.log.q(k - 1, j) ? run + 1 : 0;
        same += run > 0;
        m.longest_repeat[j] = std::max(m.longest_repeat[j], run);
      }
      m.repeat_share[j] +=
          static_cast<double>(same) / (day.log.rows() - 1) / static_cast<double>(days.size());
    }
  }
  m.repeat_share = m.repeat_share.cwiseMax(kFewestRepeats).cwiseMin(kMostRepeats);
  m.torque_rms = (m.torque_rms / rows).cwiseSqrt();
  m.q_noise = joint_medians(q);
  m.dq_noise = joint_medians(dq);
  return m;
}

}  // namespace faultline
