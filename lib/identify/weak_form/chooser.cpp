// SPDX-License-Identifier: MIT
#include "lib/identify/weak_form/chooser.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/matrix/decompositions.hpp"

namespace faultline {
namespace {

constexpr int kFolds = 5;              // parts of the logs' time, if there are too few logs
constexpr int kLogsForFolds = 3;       // with as many, whole logs are held out,
constexpr int kMostFolds = 10;         // each alone up to this number,
constexpr double kFoldBlock_s = 2.0;   // otherwise blocks of a log in turn,
constexpr int kBlocksAFold = 4;        // shorter ones if a fold would have fewer,
constexpr double kLeastBlock_s = 0.2;  // but not shorter than this
constexpr double kYardstick_s = 0.16;  // the window length nearest to it judges choices
constexpr int kOthers = 3;             // columns after the base: viscous, offset, skew
constexpr double kMomentsRank = 1e-8;  // of the largest eigenvalue of the scaled moments: smaller are zero

constexpr int kScaleRounds = 4;              // in which the fit and the scales of the residual are renewed
constexpr double kChooserLeastScale = 0.03;  // of the largest of its unit: no joint is explained so well

int log_count(const WeakWindows& windows) {
  int count = 0;
  for (const WeakWindow& w : windows.all()) count = std::max(count, w.log + 1);
  return count;
}

/// Returns the length of the blocks of time that make folds, s.
double fold_block_s(const WeakWindows& windows) {
  std::map<int, std::pair<double, double>> spans;
  for (const WeakWindow& w : windows.all()) {
    auto& [first, last] = spans.emplace(w.log, std::pair{w.time_s, w.time_s}).first->second;
    first = std::min(first, w.time_s);
    last = std::max(last, w.time_s);
  }
  double seconds = 0.0;
  for (const auto& [log, span] : spans) seconds += span.second - span.first;
  return std::clamp(seconds / (kFolds * kBlocksAFold), kLeastBlock_s, kFoldBlock_s);
}

/// Returns the fold of a window: one of `logs` folds of logs, or blocks of time in turn if that is 0.
int fold_of(const WeakWindow& w, int logs, double block_s) {
  return logs > 0 ? w.log % logs : static_cast<int>(std::floor(w.time_s / block_s)) % kFolds;
}

int nearest_set(const std::vector<WeakWindows>& sets, double length_s) {
  int best = 0;
  for (std::size_t i = 1; i < sets.size(); ++i)
    if (std::abs(elementary::log(sets[i].length_s() / length_s)) <
        std::abs(elementary::log(sets[best].length_s() / length_s)))
      best = static_cast<int>(i);
  return best;
}

/// Solves n x = r for columns of any scale, without the directions that the data do not determine.
Eigen::VectorXd solve_scaled(const Eigen::MatrixXd& n, const Eigen::VectorXd& r) {
  if (r.size() == 0) return r;
  const Eigen::VectorXd scale = n.diagonal().cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
  const SymmetricEigen eigen = symmetric_eigen(scale.asDiagonal() * n * scale.asDiagonal());
  const double least = kMomentsRank * std::max(eigen.values.maxCoeff(), 1e-300);
  Eigen::VectorXd part = eigen.vectors.transpose() * scale.cwiseProduct(r);
  for (Eigen::Index i = 0; i < part.size(); ++i)
    part[i] = eigen.values[i] > least ? part[i] / eigen.values[i] : 0.0;
  return scale.cwiseProduct(eigen.vectors * part);
}

/// Returns, by joint, the extra terms that its balances depend on.
std::vector<std::vector<int>> extra_by_joint(const ParameterSpace& space) {
  std::vector<std::vector<int>> out(space.joints());
  for (int j = 0; j < space.joints(); ++j)
    for (int i = 0; i < static_cast<int>(space.extra.size()); ++i) {
      const ExtraTerm& term = space.extra[i];
      if (is_of_shared_drive(term.kind)
              ? space.chain.shared_drives[term.index].along[j] != 0.0
              : term.joint == Joint::at(j) || term.kind == ExtraKind::gear_compliance)
        out[j].push_back(i);
    }
  return out;
}

double gain_at(const WeakChoice& choice, int j) { return choice.gain.empty() ? 1.0 : choice.gain[j]; }

/// Returns the scales of the residual, bounded below so that no joint decides alone: an almost undriven joint
/// is explained best by zero mass.
Eigen::VectorXd bounded(const ParameterSpace& space, const Eigen::VectorXd& rms,
                        const Eigen::VectorXd& torque) {
  Eigen::VectorXd out(rms.size());
  for (int j = 0; j < space.joints(); ++j) {
    const bool driven = torque[j] > kUndrivenShare * largest_alike(space, torque, j);
    out[j] = std::max({rms[j], (driven ? kChooserLeastScale : 1.0) * largest_alike(space, rms, j), 1e-12});
  }
  return out;
}

}  // namespace

Eigen::VectorXd HeldOutError::rms() const {
  const Eigen::RowVectorXd count = rows.colwise().sum().cwiseMax(1.0);
  return square.cwiseProduct(rows).colwise().sum().cwiseQuotient(count).cwiseSqrt().transpose();
}

Chooser::Chooser(const WeakSets& windows, double phi, const Eigen::VectorXd& start)
    : space_(windows.space), start_(start), shifts_(windows.shifts), joints_(windows.space.joints()) {
  yardstick_ = nearest_set(windows.sets, kYardstick_s);
  const int logs = log_count(windows.sets[0]);
  const int by_log = logs >= kLogsForFolds ? std::min(logs, kMostFolds) : 0;
  folds_ = by_log > 0 ? by_log : kFolds;
  folds_are_logs_ = by_log == logs;
  const double block_s = fold_block_s(windows.sets[0]);
  const int rigid = space_.rigid();
  extra_ = extra_by_joint(space_);
  moments_.resize(windows.sets.size() * folds_ * joints_);
  for (std::size_t set = 0; set < windows.sets.size(); ++set)
    for (int j = 0; j < joints_; ++j) {
      const int torque = torque_begin(j), count = torque + shifts_.count();
      for (int fold = 0; fold < folds_; ++fold)
        moments_[(set * folds_ + fold) * joints_ + j].sum.setZero(count, count);
      Eigen::VectorXd row(count);
      const std::vector<bool> moving = moving_windows(windows, static_cast<int>(set), j);
      const auto& all = windows.sets[set].all();
      for (std::size_t k = 0; k < all.size(); ++k) {
        if (!moving[k]) continue;
        const WeakWindow& w = all[k];
        row.head(rigid) = w.base.row(j);
        row[rigid] = w.viscous[j];
        row[rigid + 1] = 1.0;
        row[rigid + 2] = w.skew[j];
        row.segment(rigid + kOthers, kWidths) = w.coulomb.row(j);
        for (std::size_t i = 0; i < extra_[j].size(); ++i)
          row[rigid + kOthers + kWidths + static_cast<int>(i)] = w.extra(j, extra_[j][i]);
        for (int i = 0; i < shifts_.count(); ++i)
          row[torque + i] = (1.0 - phi) * w.torque(j, i) + phi * w.torque(j, std::max(i - 1, 0));
        Moments& m = moments_[(set * folds_ + fold_of(w, by_log, block_s)) * joints_ + j];
        m.sum.selfadjointView<Eigen::Lower>().rankUpdate(row);
        m.rows += 1.0;
      }
    }
  for (Moments& m : moments_) m.sum.triangularView<Eigen::StrictlyUpper>() = m.sum.transpose();
}

/// Returns the first of the columns of a joint's torque.
int Chooser::torque_begin(int j) const {
  return space_.rigid() + kOthers + kWidths + static_cast<int>(extra_[j].size());
}

/// Returns the columns of a joint's moments that a choice uses, without its torque.
std::vector<Chooser::Column> Chooser::columns(const WeakChoice& choice, int j) const {
  const int rigid = space_.rigid(), coulomb = rigid + kOthers, extra = coulomb + kWidths;
  std::vector<Column> out;
  for (int p = 0; p < rigid; ++p) out.push_back({p, p});
  out.push_back({rigid, space_.viscous(j)});
  out.push_back({coulomb + choice.width[j], space_.coulomb(j)});
  out.push_back({rigid + 1, space_.offset(j)});
  out.push_back({coulomb + choice.bend[j], space_.bend(j)});
  out.push_back({rigid + 2, space_.skew(j)});
  for (int i = 0; i < static_cast<int>(extra_[j].size()); ++i)
    out.push_back({extra + i, space_.extra_begin() + extra_[j][i]});
  return out;
}

/// Returns the column of a joint's torque with the shift of a choice.
int Chooser::torque_column(const WeakChoice& choice, int j) const {
  return torque_begin(j) + choice.shift[j] - shifts_.first;
}

Eigen::VectorXd Chooser::fit(const WeakChoice& choice, const std::vector<bool>& wanted,
                             const Eigen::VectorXd& scale) const {
  return fit_folds(choice, wanted, scale, [](int) { return true; });
}

Eigen::VectorXd Chooser::fit_one(const WeakChoice& choice, const std::vector<bool>& wanted,
                                 const Eigen::VectorXd& scale, int fold) const {
  return fit_folds(choice, wanted, scale, [fold](int other) { return other == fold; });
}

Eigen::VectorXd Chooser::fit_folds(const WeakChoice& choice, const std::vector<bool>& wanted,
                                   const Eigen::VectorXd& scale, const std::function<bool(int)>& uses) const {
  const int linear = space_.timing();
  Eigen::MatrixXd n = Eigen::MatrixXd::Zero(linear, linear);
  Eigen::VectorXd r = Eigen::VectorXd::Zero(linear);
  for (int j = 0; j < joints_; ++j) {
    const std::vector<Column> column = columns(choice, j);
    const int torque = torque_column(choice, j);
    const double gain = gain_at(choice, j), weight = 1.0 / (scale[j] * scale[j] * gain * gain);
    for (int fold = 0; fold < folds_; ++fold) {
      if (!uses(fold)) continue;
      const Eigen::MatrixXd& m = at(choice.set[j], fold, j).sum;
      for (const Column& a : column) {
        r[a.parameter] += weight * gain * m(a.at, torque);
        for (const Column& b : column) n(a.parameter, b.parameter) += weight * m(a.at, b.at);
      }
    }
  }
  std::vector<int> free;
  Eigen::VectorXd x = start_;
  for (int p = 0; p < linear; ++p)
    if (wanted[p] && n(p, p) > 0.0) free.push_back(p), x[p] = 0.0;
  r -= n * x.head(linear);
  x(free) = solve_scaled(n(free, free), r(free));
  return x;
}

double Chooser::squared_residual(const Moments& m, const WeakChoice& choice,
                                 const Eigen::VectorXd& parameters, int j) const {
  const std::vector<Column> own = columns(choice, j);
  std::vector<int> used;
  Eigen::VectorXd v(own.size() + 1);
  for (const Column& column : own) {
    v[used.size()] = -parameters[column.parameter];
    used.push_back(column.at);
  }
  const double gain = gain_at(choice, j);
  v[used.size()] = gain;
  used.push_back(torque_column(choice, j));
  return std::max(v.dot(m.sum(used, used) * v), 0.0) / (gain * gain);
}

Eigen::VectorXd Chooser::residual_rms(const WeakChoice& choice, const Eigen::VectorXd& parameters) const {
  Eigen::VectorXd out(joints_);
  for (int j = 0; j < joints_; ++j) {
    double square = 0.0, rows = 0.0;
    for (int fold = 0; fold < folds_; ++fold) {
      square += squared_residual(at(choice.set[j], fold, j), choice, parameters, j);
      rows += at(choice.set[j], fold, j).rows;
    }
    out[j] = std::sqrt(square / std::max(rows, 1.0));
  }
  return out;
}

Eigen::VectorXd Chooser::scale(const WeakChoice& choice, const std::vector<bool>& wanted) const {
  const Eigen::VectorXd torque = residual_rms(choice, Eigen::VectorXd::Zero(space_.count()));
  Eigen::VectorXd out = torque.cwiseMax(1e-12);
  for (int round = 0; round < kScaleRounds; ++round)
    out = bounded(space_, residual_rms(choice, fit(choice, wanted, out)), torque);
  return out;
}

Eigen::VectorXd Chooser::torque(const WeakChoice& choice) const {
  WeakChoice judged = choice;
  judged.set.assign(joints_, yardstick_);
  return residual_rms(judged, Eigen::VectorXd::Zero(space_.count()));
}

Eigen::VectorXd Chooser::torque_std(const WeakChoice& choice) const {
  Eigen::VectorXd out(joints_);
  for (int j = 0; j < joints_; ++j) {
    const int y = torque_column(choice, j), one = space_.rigid() + 1;
    double rows = 0.0, sum = 0.0, square = 0.0;
    for (int fold = 0; fold < folds_; ++fold) {
      const Moments& m = at(yardstick_, fold, j);
      rows += m.rows;
      sum += m.sum(y, one);
      square += m.sum(y, y);
    }
    rows = std::max(rows, 1.0);
    out[j] = std::sqrt(std::max(square / rows - (sum / rows) * (sum / rows), 0.0));
  }
  return out;
}

HeldOutError Chooser::error(const WeakChoice& choice, const std::vector<bool>& wanted,
                            const Eigen::VectorXd& scale, bool quick) const {
  HeldOutError out;
  out.square.setZero(folds_, joints_);
  out.rows.setZero(folds_, joints_);
  out.torque.setZero(folds_, joints_);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(space_.count());
  for (int fold = 0; fold < folds_; ++fold) {
    const Eigen::VectorXd parameters =
        fit_folds(choice, wanted, scale, [fold](int other) { return other != fold; });
    for (int j = 0; j < joints_; ++j) {
      const Moments& m = at(quick ? 0 : yardstick_, fold, j);
      out.rows(fold, j) = m.rows;
      out.square(fold, j) = squared_residual(m, choice, parameters, j) / std::max(m.rows, 1.0);
      out.torque(fold, j) = squared_residual(m, choice, none, j) / std::max(m.rows, 1.0);
    }
  }
  return out;
}

double Chooser::left(const WeakChoice& choice, const std::vector<bool>& wanted,
                     const Eigen::VectorXd& scale) const {
  return residual_rms(choice, fit(choice, wanted, scale)).cwiseQuotient(scale).squaredNorm();
}

bool Chooser::suits_each(const WeakChoice& without, const WeakChoice& with, const std::vector<bool>& wanted,
                         const Eigen::VectorXd& scale, int j) const {
  if (!folds_are_logs_) return true;
  const auto residual = [&](const WeakChoice& choice, int fold) {
    return squared_residual(at(choice.set[j], fold, j), choice, fit_one(choice, wanted, scale, fold), j);
  };
  int better = 0;
  for (int fold = 0; fold < folds_; ++fold) better += residual(with, fold) < residual(without, fold);
  return 2 * better > folds_;
}

Gain gain_of(const HeldOutError& without, const HeldOutError& with, int j) {
  std::vector<double> gain;
  for (Eigen::Index fold = 0; fold < without.square.rows(); ++fold)
    if (without.rows(fold, j) > 0.0 && with.square(fold, j) > 0.0)
      gain.push_back(elementary::log(without.square(fold, j) / with.square(fold, j)));
  Gain out;
  const double n = static_cast<double>(gain.size());
  for (const double g : gain) out.mean += g / n;
  for (const double g : gain) out.error += (g - out.mean) * (g - out.mean) / (n * std::max(n - 1.0, 1.0));
  out.error = std::sqrt(out.error);
  return out;
}

bool pays(const HeldOutError& without, const HeldOutError& with, int j, double torque,
          const LeastGain& worth) {
  const Gain gain = gain_of(without, with, j);
  const double before = without.rms()[j], less = before - with.rms()[j];
  return less > worth.residual * before && less > worth.torque * torque &&
         gain.mean > worth.sure * gain.error;
}

}  // namespace faultline
