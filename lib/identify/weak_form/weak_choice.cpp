// SPDX-License-Identifier: MIT
#include "lib/identify/weak_form/weak_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

constexpr LeastGain kTerm;                                     // rotors and friction offsets
constexpr LeastGain kShift{.residual = 0.005};                 // of all joints
constexpr LeastGain kOwnShift{.residual = 0.02, .sure = 2.0};  // most logs have one delay for all joints
constexpr LeastGain kWidth{.residual = 0.02};                  // for a wider friction than the sharpest
// Friction that bends or differs by direction resembles other errors, such as an untried friction width.
constexpr LeastGain kRare{.residual = 0.1, .torque = 1e-3};
constexpr double kWindowWorthIt = 0.01;  // of the residual: a smaller gain does not justify a longer window
constexpr double kWidthsApart = 1.0;     // standard errors between two widths that held-out data distinguish
constexpr double kFarWidth = 4.0;        // times wider or sharper than the best: not plausible any more
constexpr int kShiftSweeps = 3;          // over the joints at most, each with the delays of the others
constexpr double kBendsApart = 10.0;     // times the width of the Coulomb friction, at least

/// Returns the choice with the shift, one for all of these joints, that leaves the smallest residual; its own
/// shifts if none leaves less.
WeakChoice with_best_shift(const Chooser& chooser, const std::vector<bool>& wanted,
                           const Eigen::VectorXd& scale, const std::vector<int>& joints, WeakChoice choice) {
  WeakChoice best = choice;
  double least = chooser.left(choice, wanted, scale);
  for (int s = chooser.shifts().first + 1; s <= chooser.shifts().last; ++s) {
    for (const int j : joints) choice.shift[j] = s;
    const double left = chooser.left(choice, wanted, scale);
    if (left < least) least = left, best = choice;
  }
  return best;
}

/// Chooses the shifts with the other choices given: one for all joints if it lowers the error of any and
/// raises that of none, then those of single joints that lower their error.
ModelChoice choose_shifts(const Chooser& chooser, const std::vector<bool>& wanted, ModelChoice c) {
  const int joints = chooser.space().joints();
  const Eigen::VectorXd torque = chooser.torque(c.weak);
  WeakChoice none = c.weak;
  none.shift.assign(joints, 0);
  const HeldOutError without = chooser.error(none, wanted);
  std::vector<int> all(joints);
  std::iota(all.begin(), all.end(), 0);
  // Most logs have one delay for all joints.
  WeakChoice settled = with_best_shift(chooser, wanted, chooser.scale(none, wanted), all, none);
  HeldOutError best = chooser.error(settled, wanted);
  bool helps = false, harms = false;
  for (int j = 0; j < joints; ++j) {
    helps = helps || pays(without, best, j, torque[j], kShift);
    harms = harms || pays(best, without, j, torque[j], kShift);
  }
  if (!helps || harms) settled = none, best = without;
  WeakChoice single = settled;
  for (int sweep = 0; sweep < kShiftSweeps; ++sweep) {
    const WeakChoice before = single;
    const Eigen::VectorXd scale = chooser.scale(single, wanted);
    for (const int j : all) single = with_best_shift(chooser, wanted, scale, {j}, std::move(single));
    if (single.shift == before.shift) break;
  }
  const HeldOutError with = chooser.error(single, wanted);
  std::erase_if(c.terms, [](const ModelTerm& term) { return term.kind == TermKind::delay; });
  for (int j = 0; j < joints; ++j) {
    const bool own = single.shift[j] != settled.shift[j] && pays(best, with, j, torque[j], kOwnShift) &&
                     chooser.suits_each(settled, single, wanted, chooser.scale(single, wanted), j);
    c.weak.shift[j] = own ? single.shift[j] : settled.shift[j];
    if (single.shift[j] == 0 && c.weak.shift[j] == 0) continue;
    c.terms.push_back({fmt::format("delay_{}", Joint::at(j)), Joint::at(j), c.weak.shift[j] != 0,
                       without.rms()[j], own || c.weak.shift[j] == 0 ? with.rms()[j] : best.rms()[j],
                       TermKind::delay});
  }
  return c;
}

/// Excludes friction that is bent or differs by direction: the first shifts are chosen without it.
std::vector<bool> plain(const ParameterSpace& space, std::vector<bool> wanted) {
  std::fill(wanted.begin() + space.bend(0), wanted.begin() + space.extra_begin(), false);
  return wanted;
}

/// Adds bent friction, of the width with the smallest residual of its joint, if it lowers the held-out error.
ModelChoice choose_bends(const Chooser& chooser, const std::vector<bool>& asked, ModelChoice c) {
  const ParameterSpace& space = chooser.space();
  for (int j = 0; j < space.joints(); ++j) {
    if (!asked[space.bend(j)]) continue;
    const HeldOutError without = chooser.error(c.weak, c.wanted);
    std::vector<bool> wanted = c.wanted;
    wanted[space.bend(j)] = true;
    HeldOutError best = without;
    WeakChoice bent = c.weak;
    for (int k = 0; k < kWidths; ++k) {
      if (weak_width(space, j, k) < kBendsApart * weak_width(space, j, c.weak.width[j])) continue;
      WeakChoice tried = c.weak;
      tried.bend[j] = k;
      const HeldOutError with = chooser.error(tried, wanted);
      if (with.rms()[j] < best.rms()[j]) best = with, bent = tried;
    }
    const bool kept = pays(without, best, j, chooser.torque(c.weak)[j], kRare);
    c.terms.push_back({space.name(space.bend(j)), Joint::at(j), kept, without.rms()[j], best.rms()[j]});
    if (!kept) continue;
    c.weak = bent;
    c.wanted = wanted;
  }
  return c;
}

ModelChoice choose_widths(const Chooser& chooser, ModelChoice c) {
  const Eigen::VectorXd torque = chooser.torque(c.weak);
  for (int j = 0; j < chooser.space().joints(); ++j) {
    HeldOutError best = chooser.error(c.weak, c.wanted);
    for (int k = 1; k < kCoulombWidths; ++k) {
      WeakChoice tried = c.weak;
      tried.width[j] = k;
      const HeldOutError error = chooser.error(tried, c.wanted);
      if (!pays(best, error, j, torque[j], kWidth)) continue;
      best = error;
      c.weak = tried;
    }
  }
  return c;
}

/// Returns the covariance of the parameters from friction widths that held-out data do not distinguish from
/// the chosen one: mean square of the change of the fit over those widths.
Eigen::MatrixXd width_covariance(const Chooser& chooser, const ModelChoice& c, const Eigen::VectorXd& scale) {
  const ParameterSpace& space = chooser.space();
  Eigen::MatrixXd doubt = Eigen::MatrixXd::Zero(space.count(), space.count());
  const Eigen::VectorXd chosen = chooser.fit(c.weak, c.wanted, scale);
  for (int j = 0; j < space.joints(); ++j) {
    Eigen::MatrixXd apart = Eigen::MatrixXd::Zero(space.count(), space.count());
    double alike = 1.0;
    for (int k = 0; k < kCoulombWidths; ++k) {
      WeakChoice other = c.weak;
      other.width[j] = k;
      const double ratio = weak_width(space, j, k) / weak_width(space, j, c.weak.width[j]);
      if (k == c.weak.width[j] || ratio > kFarWidth || ratio < 1.0 / kFarWidth) continue;
      const Gain loss = gain_of(chooser.error(other, c.wanted, scale), c.held_out, j);
      if (loss.mean > kWidthsApart * loss.error) continue;
      const Eigen::VectorXd step = chooser.fit(other, c.wanted, scale) - chosen;
      apart += step * step.transpose();
      alike += 1.0;
    }
    doubt += apart / alike;
  }
  return doubt;
}

ModelChoice choose_terms(const Chooser& chooser, const WantedParameters& parameters, ModelChoice c) {
  const ParameterSpace& space = chooser.space();
  for (int p = 0; p < space.extra_begin(); ++p) {
    if (!parameters.asked[p] || !parameters.optional[p] || (p >= space.bend(0) && p < space.skew(0)))
      continue;
    std::vector<bool> wanted = c.wanted;
    wanted[p] = true;
    const HeldOutError without = chooser.error(c.weak, c.wanted);
    const HeldOutError with = chooser.error(c.weak, wanted);
    const Joint joint = space.joint_of(p);
    const int j = joint.index();
    const bool kept = pays(without, with, j, chooser.torque(c.weak)[j], p >= space.bend(0) ? kRare : kTerm);
    c.terms.push_back({space.name(p), joint, kept, without.rms()[j], with.rms()[j]});
    if (kept) c.wanted = wanted;
  }
  return c;
}

/// Whether the first choice leaves joint `j` more residual, beyond noise and kWindowWorthIt.
bool loses(const HeldOutError& with, const HeldOutError& against, int j) {
  const Gain loss = gain_of(with, against, j);
  return loss.mean > std::max(loss.error, 2.0 * kWindowWorthIt);
}

/// Joints share parameters: windows too short for the velocity noise of one joint spoil the fit of the
/// others. Lengthens the shortest ones until no joint is worse than with equal windows.
ModelChoice lengthen_windows(const Chooser& chooser, int alike, const HeldOutError& with_alike,
                             ModelChoice c) {
  const int joints = chooser.space().joints();
  for (;;) {
    const HeldOutError mixed = chooser.error(c.weak, c.wanted);
    bool spoilt = false;
    for (int j = 0; j < joints; ++j) spoilt = spoilt || loses(mixed, with_alike, j);
    if (!spoilt) return c;
    int& shortest = *std::min_element(c.weak.set.begin(), c.weak.set.end());
    if (shortest >= alike) break;
    ++shortest;
  }
  c.weak.set.assign(joints, alike);
  return c;
}

/// Returns the sum of the logarithms of the residuals, so that joints count alike; a still joint has none.
double sum_of_log_residuals(const HeldOutError& error) {
  constexpr double kNothing = 1e-12;  // N m or N: far below any residual; the logarithm stays finite
  return error.rms().array().max(kNothing).unaryExpr(&elementary::log).sum();
}

ModelChoice choose_windows(const Chooser& chooser, int sets, ModelChoice c) {
  const int joints = chooser.space().joints();
  std::vector<HeldOutError> errors;
  int alike = 0;
  for (int set = 0; set < sets; ++set) {
    WeakChoice tried = c.weak;
    tried.set.assign(joints, set);
    errors.push_back(chooser.error(tried, c.wanted));
    if (sum_of_log_residuals(errors[set]) < sum_of_log_residuals(errors[alike])) alike = set;
  }
  for (int j = 0; j < joints; ++j) {
    int best = 0;
    for (int set = 1; set < sets; ++set)
      if (errors[set].rms()[j] < errors[best].rms()[j]) best = set;
    c.weak.set[j] = best;
    for (int set = best - 1; set >= 0; --set)
      if (!loses(errors[set], errors[best], j)) c.weak.set[j] = set;
  }
  return lengthen_windows(chooser, alike, errors[alike], std::move(c));
}

}  // namespace

ModelChoice choose_model(const WeakSets& windows, double phi, const Eigen::VectorXd& start,
                         const WantedParameters& parameters) {
  const ParameterSpace& space = windows.space;
  const auto& [asked, optional] = parameters;
  const int n = space.joints();
  const Chooser chooser(windows, phi, start);
  ModelChoice c;
  c.weak = {std::vector<int>(n, chooser.yardstick()), std::vector<int>(n, 0), std::vector<int>(n, 0),
            std::vector<int>(n, kWidths - 1)};
  for (std::size_t p = 0; p < asked.size(); ++p) c.wanted.push_back(asked[p] && !optional[p]);
  c = choose_shifts(chooser, plain(space, asked), std::move(c));
  c = choose_widths(chooser, std::move(c));
  c = choose_terms(chooser, parameters, std::move(c));
  c = choose_bends(chooser, asked, std::move(c));
  std::vector<bool> extra = asked;
  for (int p = space.extra_begin(); p < space.timing(); ++p) extra[p] = asked[p] && optional[p];
  c = choose_extra(chooser, extra, std::move(c));
  const std::vector<bool> wanted = c.wanted;
  c = choose_shifts(chooser, wanted, std::move(c));
  c = choose_windows(chooser, static_cast<int>(windows.sets.size()), std::move(c));
  const Eigen::VectorXd scale = chooser.scale(c.weak, c.wanted);
  c.held_out = chooser.error(c.weak, c.wanted, scale);
  c.width_covariance = width_covariance(chooser, c, scale);
  const Eigen::VectorXd rms = c.held_out.rms(), torque = chooser.torque_std(c.weak);
  for (int j = 0; j < n; ++j)
    c.held_out_r2.push_back(torque[j] > 0.0 ? 1.0 - rms[j] * rms[j] / (torque[j] * torque[j]) : 0.0);
  if (!chooser.folds_are_logs()) return c;
  c.spread.resize(space.count(), chooser.folds());
  for (int fold = 0; fold < chooser.folds(); ++fold)
    c.spread.col(fold) = chooser.fit_one(c.weak, c.wanted, scale, fold);
  return c;
}

}  // namespace faultline
