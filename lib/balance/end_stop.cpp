// SPDX-License-Identifier: MIT
#include "lib/balance/end_stop.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

constexpr double kBeyond = 0.05;     // share of the healthy range by which a joint must be outside
constexpr double kFast = 0.15;       // share of its greatest healthy speed that it has before it halts
constexpr double kHalt_s = 0.06;     // longest time of the halt
constexpr double kStays_s = 0.30;    // time for which it stays, at least
constexpr double kBounces_s = 0.30;  // time for which it bounces before it stays, at most
constexpr double kForce = 1e4;       // N m or N: standard deviation of the force of an end stop

struct Stay {
  int begin = 0, end = 0;
};

/// Returns the first row in `begin` .. `end` at which joint `j` (from 0) halts on side `side` (1: above the
/// healthy range, -1: below), even if it bounces before it stays; `end` if it does not halt.
int halted_at(const BalanceRows& rows, const BalanceModel& model, int j, double side, const Stay& stay) {
  const double row_s = model.setting.row_s();
  const int before = std::max(1, static_cast<int>(std::lround(kHalt_s / row_s)));
  const int after = std::max(2, static_cast<int>(std::lround(kStays_s / row_s)));
  if (stay.end - stay.begin <= after) return stay.end;
  const double slow = std::max(
      3.0 * (model.dq_noise[j] > 0.0 && model.setting.measures_velocity(j) ? model.dq_noise[j] : 0.0),
      0.5 * model.setting.friction_width[j]);
  const int bounces = static_cast<int>(std::lround(kBounces_s / row_s));
  const auto speed = rows.dq.col(j);
  int first = -1;
  for (int k = stay.begin; k + after < stay.end; ++k) {
    if (speed[k] * side >= slow) continue;
    const int from = std::max(0, k - before);
    if ((side * speed.segment(from, k - from + 1)).maxCoeff() <= kFast * model.top_speed[j]) continue;
    if (first < 0 || k - first > bounces) first = k;
    if (speed.segment(k + before, after - before).cwiseAbs().mean() < 2.0 * slow) return first;
  }
  return stay.end;
}

}  // namespace

Eigen::MatrixXd stop_std(const BalanceRows& rows, const BalanceModel& model) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(rows.rows(), rows.joints());
  const int reach = static_cast<int>(std::ceil(3.0 * model.setting.kernel_s / model.setting.row_s()));
  for (int j = 0; j < rows.joints(); ++j) {
    const double margin = kBeyond * (model.q_high[j] - model.q_low[j]);
    const auto side = [&](int k) {
      return rows.q(k, j) > model.q_high[j] + margin ? 1 : rows.q(k, j) < model.q_low[j] - margin ? -1 : 0;
    };
    for (int k = 0; k < rows.rows();) {
      const int s = side(k);
      int end = k + 1;
      while (end < rows.rows() && side(end) == s) ++end;
      if (s != 0) {
        const int at = halted_at(rows, model, j, s, {k, end});
        if (at < end)
          for (int i = std::max(0, at - reach); i < std::min(rows.rows(), end + reach); ++i)
            out(i, j) = kForce;
      }
      k = end;
    }
  }
  return out;
}

}  // namespace faultline
