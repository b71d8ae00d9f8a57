// SPDX-License-Identifier: MIT
#include "lib/explain/log_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/balance/rest.hpp"
#include "lib/balance/smoothing.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"
#include "lib/explain/day/own_noise.hpp"
#include "lib/explain/free_form.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kForgotten = 1e-9;    // share of a change of a velocity: rows with less count as unchanged
constexpr double kCorrectedStd = 0.1;  // share of a false reading's size: its error once corrected (std)
constexpr double kSizeDoubt = 0.05;    // the same of a fault that began before the log
constexpr int kNoiseRounds = 3;        // rounds that estimate the log's own noise, at most

constexpr double kModelShare = 0.004;  // share of each model term: error of the model
constexpr double kLeastNoiseLevel = 0.3,
                 kMostNoiseLevel = 4.0;  // bounds of the noise, times that of the healthy logs

/// Returns the sum of squares of the terms of the model, each a column times its parameter: inertia, gravity
/// and friction.
MatrixXd squared_terms(const BalanceRows& rows, const ColumnLayout& layout, const VectorXd& theta) {
  MatrixXd out(rows.rows(), rows.joints());
  const int rigid = layout.rigid();
  for (int j = 0; j < rows.joints(); ++j)
    out.col(j) = (rows.column[j].leftCols(rigid) * theta.head(rigid).asDiagonal()).rowwise().squaredNorm();
  return out;
}

/// Returns the white noise of a log over that of the healthy logs, by joint.
VectorXd row_noise_level(const UniformLog& log, const BalanceModel& model) {
  VectorXd out(log.joints());
  for (int j = 0; j < out.size(); ++j) {
    const bool by_velocity = model.setting.measures_velocity(j) && log.dq.rows() > 0;
    const double now = by_velocity ? log.dq_noise[j] : log.q_noise[j],
                 usual = by_velocity ? model.dq_noise[j] : model.q_noise[j];
    out[j] = std::clamp(usual > 0.0 ? now / usual : 1.0, kLeastNoiseLevel, kMostNoiseLevel);
  }
  return out;
}

/// Returns the standard deviation of each row (rows x joints, N m or N): its noise, the error of each model
/// term, and the unknown force of an end stop.
MatrixXd row_deviation(const BalanceRows& rows, const BalanceModel& model, const VectorXd& loudness) {
  const MatrixXd noise = row_std(rows, model.setting, model.noise, loudness), stop = stop_std(rows, model),
                 terms = squared_terms(rows, model.layout(), model.theta);
  return (noise.array().square() + stop.array().square() + kModelShare * kModelShare * terms.array()).sqrt();
}

/// Returns the column of the remaining error of a false reading that was corrected.
FaultColumns reading_column(const LogFit& fit, const FaultClaim& claim) {
  const double doubt = kCorrectedStd * std::abs(claim.size[0]);
  return {StackedColumns((fit.residual() - residual_without(fit, claim, doubt)) / doubt),
          VectorXd::Constant(1, doubt * doubt)};
}

}  // namespace

Stacked residual_without(const LogFit& fit, FaultClaim claim, double size) {
  claim.size = VectorXd::Constant(1, size);
  return fit.residual_of(without_position_error(fit.log(), claim), claim.joint.index(), claim.onset_s);
}

FaultColumns columns_of(const LogFit& fit, const FaultClaim& claim) {
  if (const LinearFault* fault = linear_of(fit.linear(), claim))
    return fit.between(fault->columns, claim.onset_s, claim.end_s);
  return force_columns(fit.rows(), fit.model().setting, claim.onset_s, claim.end_s);
}

double Explanation::mean_square() const {
  double sum = 0.0, count = 0.0;
  for (const double v : left)
    if (!std::isnan(v)) sum += v * v, count += 1.0;
  return count > 0.0 ? sum / count : 1.0;
}

ResidualWithin residual_within(const LogFit& fit, const FaultClaim& claim, const Explanation& e) {
  ResidualWithin out{VectorXd::Zero(fit.joints()), VectorXd::Zero(fit.joints())};
  for (int k = 0; k < fit.count(); ++k) {
    if (fit.time_s()[k] <= claim.onset_s || fit.time_s()[k] >= claim.end_s) continue;
    for (int j = 0; j < fit.joints(); ++j) {
      const double left = e.left[j * fit.count() + k];
      if (std::isnan(left)) continue;
      out.square[j] += left * left;
      ++out.rows[j];
    }
  }
  for (int j = 0; j < fit.joints(); ++j)
    out.square[j] = out.rows[j] > 0.0 ? out.square[j] / out.rows[j] : 1.0;
  return out;
}

LogFit::LogFit(UniformLog log, const BalanceModel& model, std::vector<FaultClaim> known,
               const std::optional<RowNoise>& noise)
    : known_(std::move(known)),
      log_(without_position_errors(std::move(log), known_)),
      model_(model),
      rows_(balance_rows(log_, model.setting, model.rigid, model.theta)),
      reading_(log_, model.setting, model.rigid, model.theta),
      noise_level_(row_noise_level(log_, model)),
      noise_(noise ? *noise : model.noise) {
  const ColumnLayout layout = model.layout();
  tip_ = payload_torque(rows_, model.payload, joints() - 1);
  if (has_piece() && count() > 0) {
    const double half_s = 0.5 * model.setting.row_s();
    end_levels_ = {VectorXd::Ones(count()) - soft_step(rows_, model.setting, time_s()[0] - half_s),
                   soft_step(rows_, model.setting, time_s()[count() - 1] + half_s)};
  }
  residual_ = stacked(rows_.torque - torque_of(rows_, model.theta));
  MatrixXd spring(count(), joints());
  for (int j = 0; j < joints(); ++j)
    spring.col(j) = rows_.column[j].middleCols(layout.spring(0), joints()) *
                    model.theta.segment(layout.spring(0), joints());
  spring_ = stacked(spring);
  known_torque_ = Stacked::Zero(residual_.size());
  for (const JointMask& mask :
       {rows_within_stiction(rows_, model, unstacked(residual_, joints())), rows_at_limit(rows_, model)}) {
    if (mask.size() == 0 || !mask.any()) continue;
    silent_.resize(mask.size(), false);
    for (std::size_t i = 0; i < silent_.size(); ++i) silent_[i] = silent_[i] || mask.data()[i];
  }
  std_ = row_deviation(rows_, model, noise_level_);
  linear_ = linear_faults(rows_, model);
  effects_ = EffectColumns(day_columns(rows_, model));
  effect_variance_ = model.day_variance;
  for (const FaultClaim& claim : known_) {
    if (silences(claim.kind)) {
      const StackedMask rows = silent_rows(rows_, model, claim);
      const VectorXd edge =
          fault_edges(rows_, model.setting, claim);  // the jolt of a halt reaches every joint
      silent_.resize(rows.size(), false);
      for (std::size_t i = 0; i < rows.size(); ++i)
        silent_[i] = silent_[i] || rows[i] || edge[static_cast<Eigen::Index>(i) % count()] > 0.0;
    } else if (falsifies_position(claim.kind)) {
      add_fault(reading_column(*this, claim), claim);
    } else {
      add_fault(columns_of(*this, claim), claim);
    }
  }
  for (std::size_t i = 0; i < silent_.size(); ++i)
    if (silent_[i]) std_.data()[i] = kNoWeight;
  whiten_effects();
  settle_healthy();
  loosen_halts();
  for (int round = 0; round < kNoiseRounds && !noise; ++round) {  // with more noise the change comes later
    RowNoise own = own_noise(*this);
    if (own == noise_) break;
    noise_ = std::move(own);
    whiten_effects();
    settle_healthy();
  }
}

/// While a joint is known to be locked, raises the noise of all rows to their residuals: its halt shakes
/// them.
void LogFit::loosen_halts() {
  MatrixXd louder = MatrixXd::Ones(count(), joints());
  for (const FaultClaim& claim : known_) {
    if (claim.kind != FaultKind::locked) continue;
    const VectorXd factor = residual_within(*this, claim, healthy_).square.cwiseMax(1.0).cwiseSqrt();
    for (int k = 0; k < count(); ++k)
      if (time_s()[k] > claim.onset_s && time_s()[k] < claim.end_s)
        louder.row(k) = louder.row(k).cwiseMax(factor.transpose());
  }
  if (louder.isOnes(0.0)) return;
  std_.array() *= louder.array();
  whiten_effects();
  settle_healthy();
}

void LogFit::whiten_effects() {
  white_ = whiteners(std_, noise_);
  white_effects_ = effects_.whitened(white_);
  effect_square_ = white_effects_.square();
  effect_factor_ = posterior_factor(effect_square_, effect_variance_.cwiseInverse());
  before_.clear();
}

/// Adds a known fault as an effect whose size is estimated; the form error of its columns is noise.
void LogFit::add_fault(const FaultColumns& columns, const FaultClaim& claim) {
  const Stacked torque = columns.column * claim.size;
  const MatrixXd inexact =
      unstacked(torque, joints()).array().colwise() * form_shares(rows_, model_.setting, claim).array();
  if (!falsifies_position(claim.kind)) {
    known_torque_ += torque;
    residual_ -= torque;
    form_errors_.push_back(stacked(inexact));
  }
  std_ = (std_.array().square() + inexact.array().square()).sqrt();
  const Eigen::Index effects = effect_variance_.size();
  effect_variance_.conservativeResize(effects + columns.sizes());
  const bool is_compared = claim.onset_s >= log_.start_s || falsifies_position(claim.kind);
  const VectorXd absent = kNoEffect * columns.variance;  // of a column without a part in the fault
  effect_variance_.tail(columns.sizes()) =
      is_compared ? VectorXd((claim.size.array() == 0.0).select(absent, columns.variance))
                  : VectorXd((kSizeDoubt * claim.size).cwiseAbs2() + 1e-6 * columns.variance);
  effects_.append(columns.column);
}

/// Explains the log without a further fault; path of a work piece and effects are estimated in turn.
void LogFit::settle_healthy() {
  if (!has_piece()) {
    healthy_ = explain(residual_, {}, {});
    return;
  }
  first_path_ = path_of(residual_, {}, true);
  PiecePath path = first_path_;
  healthy_.log_likelihood = -std::numeric_limits<double>::infinity();
  for (int round = 0; round < kPathRounds; ++round) {
    Explanation fit = explain(residual_, {}, path);
    PiecePath next = path_of(residual_ - day_torque(fit.day), {}, false);
    if (fit.log_likelihood > healthy_.log_likelihood) healthy_ = std::move(fit);
    if (next == path) break;
    path = std::move(next);
  }
}

int LogFit::first_row(double at_s) const {
  return static_cast<int>(std::lower_bound(time_s().begin(), time_s().end(), at_s) - time_s().begin());
}

int LogFit::whitened_reach(int row) const {
  Eigen::Index out = row;
  for (const Whitener& white : white_) out = std::max(out, white.reach(row));
  return static_cast<int>(out);
}

bool LogFit::is_silent(Joint joint, double time_s) const {
  return std::ranges::any_of(known_, [&](const FaultClaim& claim) {
    return silences(claim.kind) && (claim.joint == joint || silences_all(claim)) && time_s >= claim.onset_s &&
           time_s < claim.end_s;
  });
}

FaultColumns LogFit::between(const FaultColumns& columns, double onset_s, double end_s) const {
  return faultline::between(columns, rows_, model_.setting, onset_s, end_s);
}

Stacked LogFit::residual_of(const MeasuredMotion& moved, int j, double from_s) const {
  const double unmoved_s = from_s - reach_s(model_.setting) - velocity_reach_s(model_.setting, kForgotten);
  const int first = std::min(first_row(unmoved_s), count() - 1);
  const MatrixXd after = reading_.of(moved, j, first);
  Stacked out = residual_;
  for (int i = 0; i < joints(); ++i) {
    const auto rest = [&](const Stacked& v) { return v.segment(i * count() + first, count() - first); };
    out.segment(i * count() + first, count() - first) = after.col(i) - rest(spring_) - rest(known_torque_);
  }
  return out;
}

StackedColumns LogFit::whitened(const StackedColumns& columns) const {
  StackedColumns out(columns.rows(), columns.cols());
  for (int j = 0; j < joints(); ++j) {
    const auto of_joint = columns.middleRows(j * count(), count());
    if (of_joint.isZero(0.0))
      out.middleRows(j * count(), count()).setZero();
    else
      out.middleRows(j * count(), count()) = white_[j](of_joint);
  }
  return out;
}

Stacked LogFit::whitened(const Stacked& torque) const { return whitened(StackedColumns(torque)).col(0); }

Stacked LogFit::day_torque(const VectorXd& day) const { return effects_.times(day); }

Stacked LogFit::piece_torque(const VectorXd& level) const {
  return stacked(model_.piece_kg * (tip_.array().colwise() * level.array()).matrix());
}

Stacked LogFit::residual_without_fault(const Explanation& e) const {
  Stacked torque = residual_ - day_torque(e.day);
  if (e.piece_level.size() > 0) torque -= piece_torque(e.piece_level);
  return whitened(torque);
}

}  // namespace faultline
