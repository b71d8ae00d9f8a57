// SPDX-License-Identifier: MIT
// The regression of one hypothesis; the path of a work piece that comes and goes is estimated anew for each.
#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/explain/log_fit.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kGravity = 9.81;    // m/s^2: only for the scale of a work piece's weight
constexpr double kMostOfDay = 30.0;  // prior standard deviations: bound of an effect of the day
constexpr double kHeld = 1e12;       // times its precision: of an effect that is held at its bound
constexpr int kBeforeRows = 5;       // rows of onsets that share one estimate of the effects before them
constexpr int kTimeRounds = 4;       // Newton rounds for the times of the changes, at most
constexpr double kSettledTime_rows = 0.1;  // rows: a change that moves less is settled
constexpr double kFarthest_rows = 1.5;     // rows from the middle between the two rows of a change, at most

/// Returns X' p of stacked columns X and a pulse p.
VectorXd along(const WhitePulse& pulse, const Eigen::Ref<const MatrixXd>& columns) {
  VectorXd out = VectorXd::Zero(columns.cols());
  const Eigen::Index rows = columns.rows() / pulse.torque.cols();
  for (Eigen::Index j = 0; j < pulse.torque.cols(); ++j)
    out.noalias() +=
        columns.middleRows(j * rows + pulse.begin, pulse.torque.rows()).transpose() * pulse.torque.col(j);
  return out;
}

double product(const WhitePulse& a, const WhitePulse& b) {
  const Eigen::Index begin = std::max(a.begin, b.begin),
                     end = std::min(a.begin + a.torque.rows(), b.begin + b.torque.rows());
  if (begin >= end) return 0.0;
  return a.torque.middleRows(begin - a.begin, end - begin)
      .cwiseProduct(b.torque.middleRows(begin - b.begin, end - begin))
      .sum();
}

/// Returns the regression with each of the first `bounded` parameters within kMostOfDay prior standard
/// deviations: those beyond it are held at the bound. A large fault of slightly another form than its
/// hypothesis would bend the effects of the day to what no day is.
Regression regress_within(NormalEquations sums, VectorXd precision, int bounded, const MatrixXd& leading) {
  Regression fit = regress(sums, precision, leading);
  VectorXd held = VectorXd::Zero(precision.size());
  double price = 0.0;
  for (bool is_within = false; !is_within;) {
    is_within = true;
    for (int i = 0; i < bounded; ++i) {
      const double most = kMostOfDay / std::sqrt(precision[i]);
      if (held[i] != 0.0 || std::abs(fit.estimate[i]) <= most) continue;
      is_within = false;
      held[i] = std::copysign(most, fit.estimate[i]);
      sums.square += held[i] * (held[i] * sums.matrix(i, i) - 2.0 * sums.vector[i]);
      sums.vector -= held[i] * sums.matrix.col(i);
      precision[i] *= kHeld;
      price += 0.5 * kMostOfDay * kMostOfDay;
    }
    if (!is_within) fit = regress(sums, precision);  // another leading block
  }
  fit.estimate += held;
  fit.log_likelihood -= price;
  return fit;
}

void take_away(const WhitePulse& pulse, double size, Stacked& rows) {
  const Eigen::Index count = rows.size() / pulse.torque.cols();
  for (Eigen::Index j = 0; j < pulse.torque.cols(); ++j)
    rows.segment(j * count + pulse.begin, pulse.torque.rows()) -= size * pulse.torque.col(j);
}

}  // namespace

LogFit::Prepared LogFit::prepared(const Stacked& residual, const FaultColumns& columns,
                                  const StackedMask& dropped) const {
  Prepared out{.white = whitened(residual), .variance = columns.variance, .dropped = dropped};
  if (columns.column.rows() > 0)
    out.column = whitened(columns.column);
  else
    out.column.resize(residual.size(), 0);
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    if (!dropped[i]) continue;
    out.white[static_cast<Eigen::Index>(i)] = 0.0;
    out.column.row(static_cast<Eigen::Index>(i)).setZero();
    ++out.lost;
  }
  const Eigen::Index effects = effect_variance_.size(), sizes = out.column.cols();
  out.square.resize(effects + sizes, effects + sizes);
  out.square.topLeftCorner(effects, effects) =
      out.lost > 0 ? MatrixXd(effect_square_ - white_effects_.square(dropped)) : effect_square_;
  out.square.topRightCorner(effects, sizes) = white_effects_.along(out.column);
  out.square.bottomLeftCorner(sizes, effects) = out.square.topRightCorner(effects, sizes).transpose();
  out.square.bottomRightCorner(sizes, sizes) = out.column.transpose() * out.column;
  VectorXd precision(effects + sizes);
  precision << effect_variance_.cwiseInverse(), columns.variance.cwiseInverse();
  out.factor = posterior_factor(out.square, precision, out.lost > 0 ? MatrixXd() : effect_factor_);
  return out;
}

Explanation LogFit::regressed(const Prepared& h, const PieceRamps& ramps) const {
  Explanation out;
  Stacked z = h.white;
  std::vector<WhitePulse> pulses;
  if (ramps.level.size() > 0) {
    out.piece_level = ramps.level;
    z -= whitened(piece_torque(ramps.level));
    for (std::size_t i = 0; i < h.dropped.size(); ++i)
      if (h.dropped[i]) z[static_cast<Eigen::Index>(i)] = 0.0;
    pulses = white_pulses(ramps, h.dropped);
  }
  const auto effects = static_cast<int>(effect_variance_.size()), sizes = static_cast<int>(h.column.cols()),
             changes = static_cast<int>(pulses.size()), fixed = effects + sizes, all = fixed + changes;
  NormalEquations sums;
  sums.matrix.resize(all, all);
  sums.vector.resize(all);
  sums.square = z.squaredNorm();
  sums.matrix.topLeftCorner(fixed, fixed) = h.square;
  sums.vector.head(effects) = white_effects_.along(z);
  sums.vector.segment(effects, sizes) = h.column.transpose() * z;
  VectorXd precision(all);
  precision.head(fixed) << effect_variance_.cwiseInverse(), h.variance.cwiseInverse();
  for (int c = 0; c < changes; ++c) {
    const WhitePulse& pulse = pulses[c];
    precision[fixed + c] = 1.0 / pulse.variance;
    sums.vector[fixed + c] = along(pulse, z)[0];
    sums.matrix.col(fixed + c) << white_effects_.along(pulse.torque, pulse.begin), along(pulse, h.column),
        VectorXd::Zero(changes);
    for (int d = 0; d <= c; ++d) sums.matrix(fixed + d, fixed + c) = product(pulse, pulses[d]);
    sums.matrix.row(fixed + c).head(fixed + c) = sums.matrix.col(fixed + c).head(fixed + c).transpose();
  }
  const Regression fit = regress_within(std::move(sums), std::move(precision),
                                        static_cast<int>(model_.day_variance.size()), h.factor);
  out.day = fit.estimate.head(effects);
  out.size = fit.estimate.segment(effects, sizes);
  out.size_covariance = fit.covariance(effects, sizes);
  if (sizes == 0) out.day_std = fit.std().head(effects);
  out.later_s = -fit.estimate.segment(fixed, ramps.change.cols());
  out.log_likelihood =
      fit.log_likelihood - 0.5 * h.lost - kChangeOfPiece * static_cast<double>(ramps.change.cols());
  out.left = z - white_effects_.times(out.day) - h.column * out.size;
  for (int c = 0; c < changes; ++c) take_away(pulses[c], fit.estimate[fixed + c], out.left);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const StackedMask* mask : {&h.dropped, &silent_})
    for (std::size_t i = 0; i < mask->size(); ++i)
      if ((*mask)[i]) out.left[static_cast<Eigen::Index>(i)] = kNaN;
  return out;
}

VectorXd LogFit::known_times_of(const PiecePath& path) const {
  const std::vector<int> changes = changes_of(path), known = changes_of(healthy_.path);
  VectorXd out = VectorXd::Zero(static_cast<Eigen::Index>(changes.size()));
  for (std::size_t c = 0; c < changes.size(); ++c)
    for (std::size_t k = 0; k < known.size(); ++k)
      if (changes[c] == known[k])
        out[static_cast<Eigen::Index>(c)] = healthy_.later_s[static_cast<Eigen::Index>(k)];
  return out;
}

std::vector<WhitePulse> LogFit::white_pulses(const PieceRamps& ramps, const StackedMask& dropped) const {
  std::vector<WhitePulse> out;
  const auto add = [&](const VectorXd& level, double variance) {
    int begin = 0, end = count();
    while (begin < end && level[begin] == 0.0) ++begin;
    while (begin < end && level[end - 1] == 0.0) --end;
    end = whitened_reach(end);
    WhitePulse pulse{begin, MatrixXd(end - begin, joints()), variance};
    for (int j = 0; j < joints(); ++j) {
      const VectorXd torque =
          model_.piece_kg *
          tip_.col(j).segment(begin, end - begin).cwiseProduct(level.segment(begin, end - begin));
      pulse.torque.col(j) = white_[j].of(torque, begin);
      for (int k = begin; k < end && !dropped.empty(); ++k)
        if (dropped[j * count() + k]) pulse.torque(k - begin, j) = 0.0;
    }
    out.push_back(std::move(pulse));
  };
  for (Eigen::Index c = 0; c < ramps.change.cols(); ++c)
    add(ramps.change.col(c), Eigen::numext::abs2(kChangeStd_rows * model_.setting.row_s()));
  for (const VectorXd& level : end_levels_) add(level, 1.0);
  return out;
}

Explanation LogFit::explain(const Prepared& hypothesis, const PiecePath& path) const {
  if (path.empty()) return regressed(hypothesis, {});
  const double row_s = model_.setting.row_s();
  VectorXd later_s = known_times_of(path);
  Explanation best;
  best.log_likelihood = -std::numeric_limits<double>::infinity();
  for (int round = 0; round < kTimeRounds; ++round) {
    Explanation e = regressed(hypothesis, piece_ramps(path, time_s(), model_.setting.kernel_s, later_s));
    e.log_likelihood -= 0.5 * (later_s / (kChangeStd_rows * row_s)).squaredNorm();
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
  const Prepared hypothesis = prepared(residual, columns, dropped);
  if (!has_piece()) return explain(hypothesis, {});
  Explanation best;
  best.log_likelihood = -std::numeric_limits<double>::infinity();
  std::vector<PiecePath> tried;
  const auto try_start = [&](PiecePath path) {
    for (int round = 0; round < kPathRounds; ++round) {
      if (std::find(tried.begin(), tried.end(), path) != tried.end()) break;
      Explanation fit = explain(hypothesis, path);
      tried.push_back(path);
      Stacked left = residual - day_torque(fit.day);
      if (columns.sizes() > 0) left -= columns.column * fit.size;
      path = path_of(left, dropped, false);
      if (fit.log_likelihood > best.log_likelihood) best = std::move(fit);
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
  for (const StackedMask* mask : {&dropped, &silent_})
    for (std::size_t i = 0; i < mask->size(); ++i)
      if ((*mask)[i]) flat[static_cast<Eigen::Index>(i)] = kNoWeight;
  return piece_path(unstacked(left, joints()), model_.piece_kg * tip_, std);
}

VectorXd LogFit::day_before(double time) const {
  const int row = first_row(time - 2.0 * model_.setting.kernel_s);
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
