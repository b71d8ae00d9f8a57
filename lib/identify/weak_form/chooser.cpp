// SPDX-License-Identifier: MIT
#include "lib/identify/weak_form/chooser.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

constexpr int kScaleRounds = 4;              // in which the fit and the scales of the residual are renewed
constexpr double kChooserLeastScale = 0.03;  // of the largest of its unit: no joint is explained so well

bool revolute(const ParameterSpace& space, int joint) {
  return space.chain.geometry[joint].kind == AxisKind::revolute;
}

/// Returns the largest value among the joints of the same kind.
double largest_alike(const ParameterSpace& space, const Eigen::VectorXd& v, int joint) {
  double largest = 0.0;
  for (int j = 0; j < space.joints(); ++j)
    if (revolute(space, j) == revolute(space, joint)) largest = std::max(largest, v[j]);
  return largest;
}

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

Eigen::VectorXd Chooser::scale(const WeakChoice& choice, const std::vector<bool>& wanted) const {
  const Eigen::VectorXd torque = moments_.torque_rms(choice);
  Eigen::VectorXd out = torque.cwiseMax(1e-12);
  for (int round = 0; round < kScaleRounds; ++round)
    out = bounded(space_, moments_.residual_rms(choice, moments_.fit(choice, wanted, start_, out)), torque);
  return out;
}

Eigen::VectorXd Chooser::torque(const WeakChoice& choice) const {
  WeakChoice judged = choice;
  judged.set.assign(space_.joints(), moments_.yardstick());
  return moments_.torque_rms(judged);
}

Eigen::VectorXd Chooser::fit(const WeakChoice& choice, const std::vector<bool>& wanted,
                             const Eigen::VectorXd& scale) const {
  return moments_.fit(choice, wanted, start_, scale);
}

double Chooser::left(const WeakChoice& choice, const std::vector<bool>& wanted,
                     const Eigen::VectorXd& scale) const {
  return moments_.residual_rms(choice, moments_.fit(choice, wanted, start_, scale))
      .cwiseQuotient(scale)
      .squaredNorm();
}

bool Chooser::suits_each(const WeakChoice& without, const WeakChoice& with, const std::vector<bool>& wanted,
                         const Eigen::VectorXd& scale, int j) const {
  if (!moments_.folds_are_logs()) return true;
  int better = 0;
  for (int fold = 0; fold < moments_.folds(); ++fold)
    better += moments_.own_fit_residual(with, wanted, start_, scale, fold, j) <
              moments_.own_fit_residual(without, wanted, start_, scale, fold, j);
  return 2 * better > moments_.folds();
}

int Chooser::best_shift(WeakChoice choice, const std::vector<bool>& wanted, const Eigen::VectorXd& scale,
                        int j, const ShiftRange& shifts) const {
  int best = choice.shift[j];
  double least = left(choice, wanted, scale);
  for (int s = shifts.first + 1; s <= shifts.last; ++s) {
    choice.shift[j] = s;
    const double now = left(choice, wanted, scale);
    if (now < least) least = now, best = s;
  }
  return best;
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
