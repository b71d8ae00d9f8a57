// SPDX-License-Identifier: MIT
#include "lib/explain/free_form.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "lib/balance/regress.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/explain/fault_spans.hpp"
#include "lib/explain/search/white_search.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Nats of a row and joint that nothing explains: that of 1.7 standard deviations.
constexpr double kFreeRowCost = 1.5;

/// Returns the nats of each row, by joint as the rows before the change explain them, or as if each row of
/// the change had a torque of its own of usual size for the joint, whichever is less.
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

/// Returns the whitened rows that healthy robot and day are to explain: without the work piece, by its path
/// before a fault could bias the effects of the day, and 0 near changes of the piece, whose times the rows do
/// not contain.
Stacked rows_to_explain(const LogFit& fit) {
  Stacked white = fit.whitened(torque_without_piece(fit));
  const std::vector<bool> changes = near_change(fit.first_path(), kRowsOfChange);
  for (int k = 0; k < static_cast<int>(changes.size()); ++k)
    for (int j = 0; j < fit.joints() && changes[k]; ++j) white[j * fit.count() + k] = 0.0;
  return white;
}

/// Returns, by joint, the sums of the effects that reach it, before any row is added.
std::vector<NormalEquations> no_rows(const EffectColumns& effects) {
  std::vector<NormalEquations> out;
  for (int j = 0; j < effects.joints(); ++j) {
    const Eigen::Index count = effects.column(j).cols();
    out.push_back({MatrixXd::Zero(count, count), VectorXd::Zero(count)});
  }
  return out;
}

/// Adds a row, with the columns of the effects that reach it.
void add_row(const Eigen::Ref<const VectorXd>& some, double white, NormalEquations& sums) {
  sums.matrix.noalias() += some * some.transpose();
  sums.vector += white * some;
  sums.square += white * white;
  sums.rows += 1.0;
}

/// Returns the sum of squared residuals of the rows with these effects of the day.
double squared_residual(const NormalEquations& sums, const VectorXd& day) {
  return sums.square - 2.0 * day.dot(sums.vector) + day.dot(sums.matrix * day);
}

/// Returns the nats of the rows of a joint, by the sums of all of them and of those before the change: as the
/// change does not reach it, or as it does, whichever is less. `day` are the effects that reach the joint.
/// The variance of its rows is estimated from those before the change, and at least 1, that of the healthy
/// logs.
double cost_of_joint(const NormalEquations& all, const NormalEquations& before, const VectorXd& day) {
  const double seen = before.rows, rest = all.rows - seen, square = squared_residual(before, day),
               variance = std::max(1.0, (kRowsOfHealthyLogs + square) / (kRowsOfHealthyLogs + seen)),
               row = 0.5 * elementary::log(variance), costs_before = seen * row + 0.5 * square / variance,
               explained = costs_before + rest * row + 0.5 * (squared_residual(all, day) - square) / variance,
               free = costs_before + rest * (row + kFreeRowCost);
  return std::min(free, explained);
}

/// Joints whose rows a change may free.
enum class ChangeOf { all_joints, some_joints };

/// Returns the change of least cost: after it each row costs kFreeRowCost, of all joints, or only of those
/// joints whose rows would cost more if they were explained as before it.
Change cheapest_change(const LogFit& fit, const Stacked& white, ChangeOf of) {
  const int rows = fit.count(), n = fit.joints();
  const EffectColumns& white_effects = fit.white_effects();
  std::vector<MatrixXd> effects;  // by joint, reach x rows
  for (int j = 0; j < n; ++j) effects.emplace_back(white_effects.column(j).transpose());
  const std::vector<bool> changes = near_change(fit.first_path(), kRowsOfChange);
  const auto counts = [&](int k) { return changes.empty() || !changes[k]; };
  const VectorXd precision = fit.effect_variance().cwiseInverse();
  std::vector<NormalEquations> all = no_rows(white_effects), before = all;
  RecursiveRegression day(precision);
  if (of == ChangeOf::some_joints)
    for (int k = 0; k < rows; ++k)
      for (int j = 0; j < n && counts(k); ++j) add_row(effects[j].col(k), white[j * rows + k], all[j]);
  const int first = first_onset_row(fit);
  double least = std::numeric_limits<double>::infinity();
  Change best{first, 0.0, VectorXd::Zero(precision.size())};
  for (int k = 0; k + kTail < rows; ++k) {
    for (int j = 0; j < n && counts(k); ++j) {
      const int row = j * rows + k;
      day.add(effects[j].col(k), white_effects.reach(j), white[row]);
      if (of == ChangeOf::some_joints) add_row(effects[j].col(k), white[row], before[j]);
    }
    if (k < first) continue;
    double cost = 0.5 * day.square() + kFreeRowCost * n * (rows - 1 - k);
    if (of == ChangeOf::some_joints) {
      cost = 0.5 * precision.dot(day.estimate().cwiseAbs2());
      for (int j = 0; j < n; ++j)
        cost += cost_of_joint(all[j], before[j], day.estimate()(white_effects.reach(j)));
    }
    if (cost >= least) continue;
    least = cost;
    best = {k, 0.0, day.estimate()};
  }
  best.onset_s = fit.time_s()[std::min(best.last_row + 1, rows - 1)];
  return best;
}

/// Returns from when on the healthy robot explains the rows again; kNeverEnds if it does not.
double explained_again_s(const LogFit& fit, const Stacked& left, const Change& change) {
  const int rows = fit.count();
  double back = 0.0, most = kEndEvidence, out = kNeverEnds;
  for (int k = rows - 1; k > change.last_row && fit.time_s()[k] > change.onset_s + kLeastFault_s; --k) {
    for (int j = 0; j < fit.joints(); ++j)
      back += kFreeRowCost - 0.5 * Eigen::numext::abs2(left[j * rows + k]);
    if (back <= most) continue;
    most = back;
    out = fit.time_s()[k];
  }
  return out;
}

}  // namespace

Stacked torque_without_piece(const LogFit& fit) {
  if (!fit.has_piece()) return fit.residual();
  const PieceRamps ramps = piece_ramps(fit.first_path(), fit.time_s(), fit.model().setting.kernel_s);
  return fit.residual() - fit.piece_torque(ramps.level);
}

Change first_change(const LogFit& fit) {
  return cheapest_change(fit, rows_to_explain(fit), ChangeOf::some_joints);
}

FreeForm free_form(const LogFit& fit) {
  const Stacked white = rows_to_explain(fit);
  const Change change = cheapest_change(fit, white, ChangeOf::all_joints);
  FreeForm out;
  out.onset_s = change.onset_s;
  out.left = white - fit.white_effects().times(change.day);
  out.end_s = explained_again_s(fit, out.left, change);
  out.row_cost = row_costs(fit, out);
  return out;
}

}  // namespace faultline
