// SPDX-License-Identifier: MIT
#include "lib/explain/free_form.hpp"

#include <Eigen/Cholesky>
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
constexpr double kOtherEffects = 10.0;  // times their standard deviation: that of effects after a change

constexpr int kRowsOfGrid = 8;  // between two rows after which a change is looked for first

/// Returns the nats of each row, by joint as the rows before the change explain them, or as if each row of
/// the change had a torque of its own of usual size for the joint, whichever is less.
VectorXd row_costs(const LogFit& fit, const FreeForm& change) {
  const int rows = fit.count();
  VectorXd out = VectorXd::Zero(rows);
  for (int j = 0; j < fit.joints(); ++j) {
    const VectorXd explained = 0.5 * change.left.segment(j * rows, rows).cwiseAbs2();
    VectorXd free = explained;
    for (int k = 0; k < rows; ++k)
      if (fit.time_s()[k] >= change.onset_s && fit.time_s()[k] <= change.end_s)
        free[k] = free_row_price(fit, k, j);
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

/// Returns the sum of squared residuals of the rows with these effects of the day.
double squared_residual(const NormalEquations& sums, const VectorXd& day) {
  return sums.square - 2.0 * day.dot(sums.vector) + day.dot(sums.matrix * day);
}

/// Returns the nats of the rows after a change if the effects that reach their joint have other values than
/// before it, `day`: the marginal likelihood of their regression. `variance` is that of a row.
double cost_by_other_effects(const NormalEquations& all, const NormalEquations& before,
                             const VectorXd& precision, const VectorXd& day, double variance) {
  const MatrixXd matrix = all.matrix - before.matrix;
  const VectorXd vector = all.vector - before.vector - matrix * day;  // of what the day leaves
  const double square = squared_residual(all, day) - squared_residual(before, day);
  const NormalEquations after{matrix / variance, vector / variance, square / variance,
                              all.rows - before.rows};
  return -regress(after, precision / Eigen::numext::abs2(kOtherEffects)).log_likelihood;
}

/// Returns the nats of the rows of a joint, by the sums of all of them and of those before the change: as the
/// change does not reach it, or as it does, by other effects or a torque of its own in each row, whichever is
/// least. `day` are the effects that reach the joint, of inverse variance `precision`. The variance of its
/// rows is estimated from those before the change, and at least 1, that of the healthy logs.
double cost_of_joint(const NormalEquations& all, const NormalEquations& before, const VectorXd& precision,
                     const VectorXd& day) {
  const double seen = before.rows, rest = all.rows - seen, square = squared_residual(before, day),
               variance = std::max(1.0, (kRowsOfHealthyLogs + square) / (kRowsOfHealthyLogs + seen)),
               row = 0.5 * elementary::log(variance), costs_before = seen * row + 0.5 * square / variance,
               explained = costs_before + rest * row + 0.5 * (squared_residual(all, day) - square) / variance,
               free = costs_before + rest * (row + kFreeRowCost),
               others =
                   costs_before + rest * row + cost_by_other_effects(all, before, precision, day, variance);
  return std::min({free, explained, others});
}

/// Joints whose rows a change may free.
enum class ChangeOf { all_joints, some_joints };

/// The first rows of a log, as sums by joint, and what a change after them would cost. The whitened residual
/// is 0 near changes of the work piece, and these rows do not count.
class RowsBeforeChange {
 public:
  RowsBeforeChange(const LogFit& fit, const Stacked& white)
      : effects_(fit.white_effects()),
        white_(white),
        precision_(fit.effect_variance().cwiseInverse()),
        rows_(fit.count()),
        counted_(VectorXd::Ones(fit.count())),
        before_(no_rows(effects_)) {
    const std::vector<bool> changes = near_change(fit.first_path(), kRowsOfChange);
    for (int k = 0; k < static_cast<int>(changes.size()); ++k)
      if (changes[k]) counted_[k] = 0.0;
    for (int j = 0; j < effects_.joints(); ++j)
      columns_.emplace_back(effects_.column(j).transpose() * counted_.asDiagonal());
  }

  int rows() const { return rows_; }
  int joints() const { return effects_.joints(); }

  void restart() {
    before_ = no_rows(effects_);
    added_ = 0;
  }

  /// Adds the rows up to `end`, exclusively.
  void add(int end) {
    const int count = end - added_;
    for (int j = 0; j < joints(); ++j) {
      const auto columns = columns_[j].middleCols(added_, count);
      const auto white = white_.segment(j * rows_ + added_, count);
      before_[j].matrix.noalias() += columns * columns.transpose();
      before_[j].vector.noalias() += columns * white;
      before_[j].square += white.squaredNorm();
      before_[j].rows += counted_.segment(added_, count).sum();
    }
    added_ = end;
  }

  const std::vector<NormalEquations>& sums() const { return before_; }

  /// Returns the effects of the day, estimated from the rows.
  VectorXd day() const {
    MatrixXd matrix = precision_.asDiagonal();
    for (int j = 0; j < joints(); ++j) {
      const std::vector<int>& reach = effects_.reach(j);
      for (std::size_t b = 0; b < reach.size(); ++b)
        for (std::size_t a = 0; a < reach.size(); ++a) matrix(reach[a], reach[b]) += before_[j].matrix(a, b);
    }
    return matrix.llt().solve(vector());
  }

  /// Returns the nats if each later row of every joint costs kFreeRowCost.
  double cost_of_all(const VectorXd& day, int row) const {
    double square = -day.dot(vector());
    for (const NormalEquations& joint : before_) square += joint.square;
    return 0.5 * square + kFreeRowCost * joints() * (rows_ - 1 - row);
  }

  /// Returns the nats if later rows cost that only for joints for which it is less than to explain them.
  double cost_of_some(const VectorXd& day, const std::vector<NormalEquations>& all) const {
    double cost = 0.5 * precision_.dot(day.cwiseAbs2());
    for (int j = 0; j < joints(); ++j)
      cost += cost_of_joint(all[j], before_[j], precision_(effects_.reach(j)), day(effects_.reach(j)));
    return cost;
  }

 private:
  VectorXd vector() const {
    VectorXd out = VectorXd::Zero(precision_.size());
    for (int j = 0; j < joints(); ++j) out(effects_.reach(j)) += before_[j].vector;
    return out;
  }

  const EffectColumns& effects_;
  const Stacked& white_;
  VectorXd precision_;
  int rows_;
  VectorXd counted_;               ///< by row: 1, or 0 near a change of the work piece
  std::vector<MatrixXd> columns_;  ///< by joint, reach x rows
  int added_ = 0;
  std::vector<NormalEquations> before_;  ///< by joint, of the rows that were added
};

/// Returns the change of least cost: after it each row costs kFreeRowCost, of all joints, or only of those
/// joints whose rows would cost more if they were explained as before it. Looks at every row of a coarse
/// grid, and at each row beside the best of them.
Change cheapest_change(const LogFit& fit, const Stacked& white, ChangeOf of) {
  RowsBeforeChange before(fit, white);
  const int rows = before.rows(), first = first_onset_row(fit, FaultKind::unknown);
  std::vector<NormalEquations> all;
  if (of == ChangeOf::some_joints) {
    before.add(rows);
    all = before.sums();
    before.restart();
  }
  double least = std::numeric_limits<double>::infinity();
  Change best{first, 0.0, VectorXd::Zero(fit.effect_variance().size())};
  const auto judge = [&](int from, int to, int step) {
    before.restart();
    for (int k = from; k < to; k += step) {
      before.add(k + 1);
      VectorXd day = before.day();
      const double cost =
          of == ChangeOf::some_joints ? before.cost_of_some(day, all) : before.cost_of_all(day, k);
      if (cost >= least) continue;
      least = cost;
      best = {k, 0.0, std::move(day)};
    }
  };
  judge(first, rows - kTail, kRowsOfGrid);
  judge(std::max(first, best.last_row - kRowsOfGrid + 1), std::min(best.last_row + kRowsOfGrid, rows - kTail),
        1);
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

double free_row_price(const LogFit& fit, int row, int j) {
  const double usual = fit.model().torque_rms[j] / fit.noise().joint[j].innovation;
  return 0.5 * elementary::log1p(Eigen::numext::abs2(usual / fit.std()(row, j)));
}

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
