// SPDX-License-Identifier: MIT
#include "lib/explain/free_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/explain/fault_end.hpp"
#include "lib/explain/white_search.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFreeRowCost =
    1.5;  // nats of a row and joint of which nothing is said: that of 1.7 standard deviations

/// Nats that each row costs: by joint as the rows before the change explain them, or each row of the change
/// with a torque of its own as large as is usual for the joint, whichever costs less.
VectorXd row_costs(const LogFit& fit, const FreeForm& change) {
  const int rows = fit.count();
  VectorXd out = VectorXd::Zero(rows);
  for (int j = 0; j < fit.joints(); ++j) {
    const VectorXd explained = 0.5 * change.left.segment(j * rows, rows).cwiseAbs2();
    const double usual = fit.model().torque_rms[j] / fit.noise().joint[j].innovation;
    VectorXd free = explained;
    for (int k = 0; k < rows; ++k)
      if (fit.time_s()[k] >= change.onset_s && fit.time_s()[k] <= change.end_s)
        free[k] = 0.5 * elementary::log1p(Eigen::numext::abs2(usual / fit.std()(k, j)));
    out += free.sum() < explained.sum() ? free : explained;
  }
  return out;
}

}  // namespace

FreeForm free_form(const LogFit& fit) {
  const int rows = fit.count(), n = fit.joints();
  const int effects = static_cast<int>(fit.effect_variance().size());
  Stacked torque = fit.residual();
  if (fit.has_piece())  // as seen before a fault could bend the effects of the day
    torque -=
        fit.piece_torque(piece_ramps(fit.first_path(), fit.time_s(), fit.model().setting.kernel_s).level);
  Stacked white = fit.whitened(torque);
  const std::vector<bool> changes = near_change(fit.first_path(), kRowsOfChange);
  for (int k = 0; k < static_cast<int>(changes.size()); ++k)  // the time of a change is not known to a row
    for (int j = 0; j < n && changes[k]; ++j) white[j * rows + k] = 0.0;
  NormalEquations sums{MatrixXd::Zero(effects, effects), VectorXd::Zero(effects)};
  const VectorXd precision = fit.effect_variance().cwiseInverse();
  const int first = std::max(6, static_cast<int>(kLead_s / fit.model().setting.row_s()));
  double least = std::numeric_limits<double>::infinity();
  int best = first;
  VectorXd day = VectorXd::Zero(effects);
  for (int k = 0; k + kTail < rows; ++k) {
    for (int j = 0; j < n; ++j) {
      const double y = white[j * rows + k];
      if (!changes.empty() && changes[k]) continue;
      const VectorXd w = fit.white_effects().row(j * rows + k).transpose();
      sums.matrix += w * w.transpose();
      sums.vector += y * w;
      sums.square += y * y;
    }
    if (k < first) continue;
    const Regression before = regress(sums, precision);
    const double cost =
        0.5 * (sums.square - before.estimate.dot(sums.vector)) + kFreeRowCost * n * (rows - 1 - k);
    if (cost >= least) continue;
    least = cost;
    best = k;
    day = before.estimate;
  }
  FreeForm out;
  out.onset_s = fit.time_s()[std::min(best + 1, rows - 1)];
  out.left = white - fit.white_effects() * day;
  out.day = std::move(day);
  double back = 0.0, most = kEndEvidence;
  for (int k = rows - 1; k > best && fit.time_s()[k] > out.onset_s + kLeastFault_s; --k) {
    for (int j = 0; j < n; ++j) back += kFreeRowCost - 0.5 * Eigen::numext::abs2(out.left[j * rows + k]);
    if (back <= most) continue;
    most = back;
    out.end_s = fit.time_s()[k];
  }
  out.row_cost = row_costs(fit, out);
  return out;
}

EvidenceCourse evidence_course(const LogFit& fit, const FreeForm& change) {
  const double edge = reach_s(fit.model().setting);
  EvidenceCourse out;
  double sum = 0.0;
  for (int k = 0; k < fit.count(); ++k) {
    if (fit.time_s()[k] < change.onset_s - edge) continue;
    for (int j = 0; j < fit.joints(); ++j) {
      const double z = change.left[j * fit.count() + k];
      sum += 0.5 * z * z - 0.5;
    }
    out.time_s.push_back(std::max(fit.time_s()[k] + edge, change.onset_s));
    out.nats.push_back(sum);
  }
  return out;
}

}  // namespace faultline
