// SPDX-License-Identifier: MIT
#include "lib/evidence/healthy_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faultline {
namespace {

struct JointSums {
  double q_low = std::numeric_limits<double>::infinity();
  double q_high = -std::numeric_limits<double>::infinity();
  double dq_squared = 0.0, tau_squared = 0.0, tau_largest = 0.0, tau_jump = 0.0;
  long long dq_count = 0, tau_count = 0, repeats = 0, pairs = 0;
  int run = 0, longest = 0;
  double last_q = std::numeric_limits<double>::quiet_NaN();
  double last_dq = std::numeric_limits<double>::quiet_NaN();
  double last_tau = std::numeric_limits<double>::quiet_NaN();
  double last_t = 0.0;

  void begin_log() {
    run = 0;
    last_q = last_dq = last_tau = std::numeric_limits<double>::quiet_NaN();
  }

  void take(double t, double q, double dq, double tau) {
    const bool derived = !std::isfinite(dq) && std::isfinite(q) && std::isfinite(last_q) && t > last_t;
    const double velocity = derived ? (q - last_q) / (t - last_t) : dq;
    if (std::isfinite(q)) {
      q_low = std::min(q_low, q);
      q_high = std::max(q_high, q);
    }
    if (std::isfinite(velocity)) dq_squared += velocity * velocity, ++dq_count;
    if (std::isfinite(tau)) {
      tau_squared += tau * tau;
      tau_largest = std::max(tau_largest, std::abs(tau));
      if (std::isfinite(last_tau)) tau_jump = std::max(tau_jump, std::abs(tau - last_tau));
      ++tau_count;
    }
    const bool repeated = q == last_q && (dq == last_dq || (std::isnan(dq) && std::isnan(last_dq)));
    run = repeated ? run + 1 : 0;
    longest = std::max(longest, run);
    repeats += repeated;
    ++pairs;
    last_q = q;
    last_dq = dq;
    last_tau = tau;
    last_t = t;
  }
};

double root_mean(double sum, long long count) {
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
}

}  // namespace

HealthyStatistics healthy_statistics(std::span<LogSource* const> logs, int joints) {
  std::vector<JointSums> sums(joints);
  HealthyStatistics out;
  for (LogSource* log : logs) {
    log->rewind();
    for (JointSums& s : sums) s.begin_log();
    for (Log segment; log->next(segment);) {
      out.rows += segment.rows();
      for (int j = 0; j < joints; ++j)
        for (int k = 0; k < segment.rows(); ++k)
          sums[j].take(segment.time[k], segment.q[j][k],
                       segment.dq.empty() ? std::numeric_limits<double>::quiet_NaN() : segment.dq[j][k],
                       segment.tau.empty() ? 0.0 : segment.tau[j][k]);
    }
  }
  for (const JointSums& s : sums) {
    out.q_low.push_back(s.q_low);
    out.q_high.push_back(s.q_high);
    out.velocity_rms.push_back(root_mean(s.dq_squared, s.dq_count));
    out.torque_rms.push_back(root_mean(s.tau_squared, s.tau_count));
    out.torque_largest.push_back(s.tau_largest);
    out.torque_jump.push_back(s.tau_jump);
    out.repeat_share.push_back(s.pairs > 0 ? static_cast<double>(s.repeats) / static_cast<double>(s.pairs)
                                           : 0.0);
    out.longest_repeat.push_back(s.longest);
  }
  return out;
}

}  // namespace faultline
