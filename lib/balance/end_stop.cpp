// SPDX-License-Identifier: MIT
#include "lib/balance/end_stop.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

constexpr double kOutside = 0.05;    // share of the healthy range by which a joint must be outside
constexpr double kBounces_s = 0.30;  // time for which it bounces before it stays, at most
constexpr double kForce = 1e4;       // N m or N: standard deviation of the force of an end stop

/// Returns the first row of the stretch at which joint `j` (from 0) halts, even if it bounces before it
/// stays; the end of the stretch if it does not halt.
int halted_at(const BalanceRows& rows, const BalanceModel& model, int j, const StretchOutside& outside) {
  const double row_s = model.setting.row_s();
  const int before = std::max(1, static_cast<int>(std::lround(kHaltsIn_s / row_s)));
  const int after = std::max(2, static_cast<int>(std::lround(kStaysFor_s / row_s)));
  if (outside.end - outside.begin <= after) return outside.end;
  const double slow = std::max(
      3.0 * (model.dq_noise[j] > 0.0 && model.setting.measures_velocity(j) ? model.dq_noise[j] : 0.0),
      0.5 * model.setting.friction_width[j]);
  const int bounces = static_cast<int>(std::lround(kBounces_s / row_s));
  const auto speed = rows.dq.col(j);
  int first = -1;
  for (int k = outside.begin; k + after < outside.end; ++k) {
    if (speed[k] * outside.side >= slow) continue;
    const int from = std::max(0, k - before);
    const double fastest = (outside.side * speed.segment(from, k - from + 1)).maxCoeff();
    if (fastest <= kFastBeforeStop * model.top_speed[j]) continue;
    if (first < 0 || k - first > bounces) first = k;
    if (speed.segment(k + before, after - before).cwiseAbs().mean() < 2.0 * slow) return first;
  }
  return outside.end;
}

}  // namespace

std::vector<StretchOutside> stretches_outside(const Eigen::VectorXd& q, double low, double high) {
  const double margin = kOutside * (high - low);
  const auto side = [&](int k) { return q[k] > high + margin ? 1.0 : q[k] < low - margin ? -1.0 : 0.0; };
  std::vector<StretchOutside> out;
  for (int begin = 0, end = 0; begin < static_cast<int>(q.size()); begin = end) {
    for (end = begin + 1; end < static_cast<int>(q.size()) && side(end) == side(begin);) ++end;
    if (side(begin) != 0.0) out.push_back({side(begin), begin, end});
  }
  return out;
}

Eigen::MatrixXd stop_std(const BalanceRows& rows, const BalanceModel& model) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(rows.rows(), rows.joints());
  const int reach = static_cast<int>(std::ceil(3.0 * model.setting.kernel_s / model.setting.row_s()));
  for (int j = 0; j < rows.joints(); ++j)
    for (const StretchOutside& each : stretches_outside(rows.q.col(j), model.q_low[j], model.q_high[j])) {
      const int at = halted_at(rows, model, j, each);
      if (at == each.end) continue;
      for (int i = std::max(0, at - reach); i < std::min(rows.rows(), each.end + reach); ++i)
        out(i, j) = kForce;
    }
  return out;
}

}  // namespace faultline
