// SPDX-License-Identifier: MIT
// The work piece that comes and goes in one log, whose path is estimated anew for each hypothesis.
#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/explain/log_fit.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSaysNothing = 1e9;
constexpr double kGravity = 9.81;
constexpr int kBeforeRows = 5;             // effects before an onset are estimated anew for each so many rows
constexpr int kTimeRounds = 4;             // of the times of the changes (Newton)
constexpr double kSettledTime_rows = 0.1;  // a change that moves less is settled
constexpr double kFarthest_rows = 1.5;     // from the middle between the rows of a change

}  // namespace

VectorXd LogFit::known_times_of(const PiecePath& path) const {
  const std::vector<int> changes = changes_of(path), known = changes_of(healthy_.path);
  VectorXd out = VectorXd::Zero(static_cast<Eigen::Index>(changes.size()));
  for (std::size_t c = 0; c < changes.size(); ++c)
    for (std::size_t k = 0; k < known.size(); ++k)
      if (changes[c] == known[k])
        out[static_cast<Eigen::Index>(c)] = healthy_.later_s[static_cast<Eigen::Index>(k)];
  return out;
}

Explanation LogFit::explain(const Stacked& residual, const FaultColumns& columns, const PiecePath& path,
                            const StackedMask& dropped) const {
  if (path.empty()) return regressed(residual, columns, {}, dropped);
  const double row_s = model_.setting.row_s();
  VectorXd later_s = known_times_of(path);
  Explanation best;
  best.log_likelihood = -std::numeric_limits<double>::infinity();
  for (int round = 0; round < kTimeRounds; ++round) {
    const PieceRamps ramps = piece_ramps(path, time_s(), model_.setting.kernel_s, later_s);
    Explanation e = regressed(residual, columns, ramps, dropped);
    e.log_likelihood -= 0.5 * (later_s / (kChangeDoubt_rows * row_s)).squaredNorm();
    e.path = path;
    const VectorXd moved = e.later_s;
    e.later_s = later_s;
    const bool better = e.log_likelihood > best.log_likelihood;
    if (better) best = std::move(e);
    if (!better || moved.size() == 0 || moved.cwiseAbs().maxCoeff() < kSettledTime_rows * row_s) break;
    later_s = (later_s + moved).cwiseMax(-kFarthest_rows * row_s).cwiseMin(kFarthest_rows * row_s);
  }
  return best;
}

Explanation LogFit::explain_with_piece(const Stacked& residual, const FaultColumns& columns,
                                       const std::vector<VectorXd>& starts, double onset_s,
                                       const StackedMask& dropped) const {
  if (!has_piece()) return explain(residual, columns, {}, dropped);
  Explanation best;
  best.log_likelihood = -std::numeric_limits<double>::infinity();
  const auto try_start = [&](PiecePath path) {
    for (int round = 0; round < kPathRounds; ++round) {
      Explanation fit = explain(residual, columns, path, dropped);
      Stacked left = residual - day_torque(fit.day);
      if (columns.sizes() > 0) left -= columns.column * fit.size;
      PiecePath next = path_of(left, dropped, false);
      if (fit.log_likelihood > best.log_likelihood) best = std::move(fit);
      if (next == path) break;
      path = std::move(next);
    }
  };
  try_start(healthy_.path);
  for (const VectorXd& size : starts) {
    Stacked left = residual - day_torque(day_before(onset_s));
    if (columns.sizes() > 0) left -= columns.column * size;
    try_start(path_of(left, dropped, true));
  }
  return best;
}

PiecePath LogFit::path_of(const Stacked& left, const StackedMask& dropped, bool wide) const {
  const double step = model_.piece_kg * kGravity;
  MatrixXd std(count(), joints());
  for (int j = 0; j < joints(); ++j) {
    if (carries_weight(model_.rigid, j))
      std.col(j).setConstant(wide ? 0.25 * step : std::max(0.3, 0.03 * step));
    else
      std.col(j) = 4.0 * std_.col(j) + 0.02 * rows_.torque.col(j).cwiseAbs();
  }
  Eigen::Map<VectorXd> flat(std.data(), std.size());
  for (std::size_t i = 0; i < dropped.size(); ++i)
    if (dropped[i]) flat[static_cast<Eigen::Index>(i)] = kSaysNothing;
  return piece_path(unstacked(left, joints()), model_.piece_kg * tip_, std);
}

VectorXd LogFit::day_before(double time) const {
  const double until = time - 2.0 * model_.setting.kernel_s;
  int row = 0;
  while (row < count() && time_s()[row] < until) ++row;
  const int key = row / kBeforeRows;
  for (const auto& [known, day] : before_)
    if (known == key) return day;
  StackedMask dropped(count() * joints(), false);
  for (int j = 0; j < joints(); ++j)
    for (int k = row; k < count(); ++k) dropped[j * count() + k] = true;
  VectorXd day = explain(residual_, {}, first_path_, dropped).day;
  before_.emplace_back(key, day);
  return day;
}

}  // namespace faultline
