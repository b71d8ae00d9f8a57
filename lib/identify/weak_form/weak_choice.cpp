// SPDX-License-Identifier: MIT
#include "lib/identify/weak_form/weak_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

constexpr double kWorthIt = 0.01;          // of the held-out residual that a term must take away
constexpr double kShiftWorthIt = 0.005;    // the same for a delay of all joints
constexpr double kOwnShiftWorthIt = 0.01;  // and of one: most logs are late by one and the same
constexpr double kRareWorthIt = 0.05;  // friction that bends or differs by direction: it mimics much else,
constexpr double kRareWorthOfTorque = 2e-3;     // and what is left beside a width between two of the bank,
constexpr double kSure = 1.0, kRareSure = 2.0;  // standard errors over the folds
constexpr double kWorthOfTorque = 5e-4;         // of the joint's torque: less is of no use to anyone
constexpr double kWidthWorthIt = 0.02;          // for friction that is smoother than the windows can tell
constexpr double kWindowWorthIt = 0.01;         // less of the residual does not ask for a longer window
constexpr int kScaleRounds = 4;
constexpr int kShiftSweeps = 3;
constexpr int kBendsApart = 3;        // widths between Coulomb friction and its bend
constexpr double kLeastScale = 0.03;  // of the largest of the same unit: no joint is told that well
constexpr double kUndriven = 0.05;    // of the largest torque: such a joint asks for no mass at all

bool revolute(const ParameterSpace& space, int joint) {
  return space.chain.geometry[joint].kind == AxisKind::revolute;
}

/// Largest value among the joints of the same kind of axis.
double largest_alike(const ParameterSpace& space, const Eigen::VectorXd& v, int joint) {
  double largest = 0.0;
  for (int j = 0; j < space.joints(); ++j)
    if (revolute(space, j) == revolute(space, joint)) largest = std::max(largest, v[j]);
  return largest;
}

/// The residual's scales, none so small that a joint decides alone: a joint that is hardly driven is
/// explained best by no mass at all.
Eigen::VectorXd bounded(const ParameterSpace& space, const Eigen::VectorXd& rms,
                        const Eigen::VectorXd& torque) {
  Eigen::VectorXd out(rms.size());
  for (int j = 0; j < space.joints(); ++j) {
    const bool driven = torque[j] > kUndriven * largest_alike(space, torque, j);
    out[j] = std::max({rms[j], (driven ? kLeastScale : 1.0) * largest_alike(space, rms, j), 1e-12});
  }
  return out;
}

class Chooser {
 public:
  Chooser(const WeakMoments& moments, const ParameterSpace& space, const Eigen::VectorXd& start)
      : moments_(moments), space_(space), start_(start) {}

  Eigen::VectorXd scale(const WeakChoice& choice, const std::vector<bool>& wanted) const {
    const Eigen::VectorXd torque = moments_.torque_rms(choice);
    Eigen::VectorXd out = torque.cwiseMax(1e-12);
    for (int round = 0; round < kScaleRounds; ++round)
      out = bounded(space_, moments_.residual_rms(choice, moments_.fit(choice, wanted, start_, out)), torque);
    return out;
  }

  /// Root mean square torque of every joint in the windows that choices are judged by.
  Eigen::VectorXd torque(const WeakChoice& choice) const {
    WeakChoice judged = choice;
    judged.set.assign(space_.joints(), moments_.yardstick());
    return moments_.torque_rms(judged);
  }

  HeldOutError error(const WeakChoice& choice, const std::vector<bool>& wanted,
                     const Eigen::VectorXd& scale) const {
    return moments_.held_out(choice, wanted, start_, scale);
  }

  /// Square of what is left of all joints together, each in its scale.
  double left(const WeakChoice& choice, const std::vector<bool>& wanted, const Eigen::VectorXd& scale) const {
    return moments_.residual_rms(choice, moments_.fit(choice, wanted, start_, scale))
        .cwiseQuotient(scale)
        .squaredNorm();
  }

  /// The shift of joint `j` with which least is left of all joints together.
  int best_shift(WeakChoice choice, const std::vector<bool>& wanted, const Eigen::VectorXd& scale, int j,
                 const ShiftRange& shifts) const {
    int best = choice.shift[j];
    double least = left(choice, wanted, scale);
    for (int s = shifts.first + 1; s <= shifts.last; ++s) {
      choice.shift[j] = s;
      const double now = left(choice, wanted, scale);
      if (now < least) least = now, best = s;
    }
    return best;
  }

 private:
  const WeakMoments& moments_;
  const ParameterSpace& space_;
  const Eigen::VectorXd& start_;
};

/// Mean and standard error, over the folds, of the logarithm by which joint j's squared residual shrinks from
/// `without` to `with`: folds of gentle and of fast motion count alike.
struct Gain {
  double mean = 0.0, error = 0.0;
};

Gain gain_of(const HeldOutError& without, const HeldOutError& with, int j) {
  std::vector<double> gain;
  for (Eigen::Index fold = 0; fold < without.square.rows(); ++fold)
    if (without.rows(fold, j) > 0.0 && with.square(fold, j) > 0.0)
      gain.push_back(std::log(without.square(fold, j) / with.square(fold, j)));
  Gain out;
  const double n = static_cast<double>(gain.size());
  for (const double g : gain) out.mean += g / n;
  for (const double g : gain) out.error += (g - out.mean) * (g - out.mean) / (n * std::max(n - 1.0, 1.0));
  out.error = std::sqrt(out.error);
  return out;
}

/// Whether joint `j` is told clearly better by `with`: by `share` of its residual, by a share of its torque,
/// and by more than chance does.
bool pays(const HeldOutError& without, const HeldOutError& with, int j, double share, double torque,
          double sure = kSure, double worth = kWorthOfTorque) {
  const Gain gain = gain_of(without, with, j);
  const double less = without.rms()[j] - with.rms()[j];
  return less > share * without.rms()[j] && less > worth * torque && gain.mean > sure * gain.error;
}

/// The shift that suits all joints together best: most logs are late by one and the same.
WeakChoice common_shift(const Chooser& chooser, const ShiftRange& shifts, int joints,
                        const std::vector<bool>& wanted, WeakChoice choice) {
  choice.shift.assign(joints, 0);
  const Eigen::VectorXd scale = chooser.scale(choice, wanted);
  WeakChoice best = choice;
  double least = chooser.left(choice, wanted, scale);
  for (int s = shifts.first + 1; s <= shifts.last; ++s) {
    choice.shift.assign(joints, s);
    const double left = chooser.left(choice, wanted, scale);
    if (left < least) least = left, best = choice;
  }
  return best;
}

/// Shifts that the other choices ask for: one for all joints where it pays for any and harms none, then those
/// of single joints that pay for them.
void choose_shifts(const Chooser& chooser, const ShiftRange& shifts, int joints,
                   const std::vector<bool>& wanted, ModelChoice& c) {
  const Eigen::VectorXd torque = chooser.torque(c.weak);
  const auto error_of = [&](const WeakChoice& w) {
    return chooser.error(w, wanted, chooser.scale(w, wanted));
  };
  WeakChoice none = c.weak;
  none.shift.assign(joints, 0);
  const HeldOutError without = error_of(none);
  WeakChoice settled = common_shift(chooser, shifts, joints, wanted, none);
  HeldOutError best = error_of(settled);
  bool helps = false, harms = false;
  for (int j = 0; j < joints; ++j) {
    helps = helps || pays(without, best, j, kShiftWorthIt, torque[j]);
    harms = harms || pays(best, without, j, kShiftWorthIt, torque[j]);
  }
  if (!helps || harms) settled = none, best = without;
  WeakChoice single = settled;
  for (int sweep = 0; sweep < kShiftSweeps; ++sweep) {
    const WeakChoice before = single;
    const Eigen::VectorXd scale = chooser.scale(single, wanted);
    for (int j = 0; j < joints; ++j) single.shift[j] = chooser.best_shift(single, wanted, scale, j, shifts);
    if (single.shift == before.shift) break;
  }
  const HeldOutError with = error_of(single);
  std::erase_if(c.terms, [](const ModelTerm& term) { return term.name.starts_with("delay_"); });
  for (int j = 0; j < joints; ++j) {
    const bool own = single.shift[j] != settled.shift[j] && pays(best, with, j, kOwnShiftWorthIt, torque[j]);
    c.weak.shift[j] = own ? single.shift[j] : settled.shift[j];
    if (single.shift[j] == 0 && c.weak.shift[j] == 0) continue;
    c.terms.push_back({fmt::format("delay_{}", j + 1), j, c.weak.shift[j] != 0, without.rms()[j],
                       own || c.weak.shift[j] == 0 ? with.rms()[j] : best.rms()[j]});
  }
}

/// Without friction that is bent or lopsided: nothing else is chosen with it.
std::vector<bool> plain(const ParameterSpace& space, std::vector<bool> wanted) {
  std::fill(wanted.begin() + space.bend(0), wanted.begin() + space.timing(), false);
  return wanted;
}

/// Bent friction of the width that leaves least of its joint, where it pays.
void choose_bends(const Chooser& chooser, const ParameterSpace& space, const std::vector<bool>& asked,
                  ModelChoice& c) {
  for (int j = 0; j < space.joints(); ++j) {
    if (!asked[space.bend(j)]) continue;
    const HeldOutError without = chooser.error(c.weak, c.wanted, chooser.scale(c.weak, c.wanted));
    std::vector<bool> wanted = c.wanted;
    wanted[space.bend(j)] = true;
    HeldOutError best = without;
    WeakChoice bent = c.weak;
    for (int k = c.weak.width[j] + kBendsApart; k < kWidths; ++k) {
      WeakChoice tried = c.weak;
      tried.bend[j] = k;
      const HeldOutError with = chooser.error(tried, wanted, chooser.scale(tried, wanted));
      if (with.rms()[j] < best.rms()[j]) best = with, bent = tried;
    }
    const bool kept =
        pays(without, best, j, kRareWorthIt, chooser.torque(c.weak)[j], kRareSure, kRareWorthOfTorque);
    c.terms.push_back({space.name(space.bend(j)), j, kept, without.rms()[j], best.rms()[j]});
    if (!kept) continue;
    c.weak = bent;
    c.wanted = wanted;
  }
}

void choose_widths(const Chooser& chooser, int joints, ModelChoice& c) {
  const Eigen::VectorXd torque = chooser.torque(c.weak);
  for (int j = 0; j < joints; ++j) {
    HeldOutError best = chooser.error(c.weak, c.wanted, chooser.scale(c.weak, c.wanted));
    for (int k = 1; k < kCoulombWidths; ++k) {
      WeakChoice tried = c.weak;
      tried.width[j] = k;
      const HeldOutError error = chooser.error(tried, c.wanted, chooser.scale(tried, c.wanted));
      if (!pays(best, error, j, kWidthWorthIt, torque[j])) continue;
      best = error;
      c.weak = tried;
    }
  }
}

/// The joint that a parameter is judged by: its own for friction and rotors, for others the first.
int joint_of(const ParameterSpace& space, int p) {
  if (p >= space.rigid()) return (p - space.rigid()) % space.joints();
  const std::string& name = space.base[p].name;
  return space.base[p].is_rotor ? name.back() - '1' : 0;
}

void choose_terms(const Chooser& chooser, const ParameterSpace& space, const std::vector<bool>& asked,
                  const std::vector<bool>& optional, ModelChoice& c) {
  for (int p = 0; p < space.timing(); ++p) {
    if (!asked[p] || !optional[p] || (p >= space.bend(0) && p < space.skew(0))) continue;
    std::vector<bool> wanted = c.wanted;
    wanted[p] = true;
    const HeldOutError without = chooser.error(c.weak, c.wanted, chooser.scale(c.weak, c.wanted));
    const HeldOutError with = chooser.error(c.weak, wanted, chooser.scale(c.weak, wanted));
    const int j = joint_of(space, p);
    const bool rare = p >= space.bend(0);
    const bool kept = pays(without, with, j, rare ? kRareWorthIt : kWorthIt, chooser.torque(c.weak)[j],
                           rare ? kRareSure : kSure, rare ? kRareWorthOfTorque : kWorthOfTorque);
    c.terms.push_back({space.name(p), j, kept, without.rms()[j], with.rms()[j]});
    if (kept) c.wanted = wanted;
  }
}

void choose_windows(const Chooser& chooser, int sets, int joints, ModelChoice& c) {
  std::vector<HeldOutError> errors;
  for (int set = 0; set < sets; ++set) {
    WeakChoice tried = c.weak;
    tried.set.assign(joints, set);
    errors.push_back(chooser.error(tried, c.wanted, chooser.scale(tried, c.wanted)));
  }
  for (int j = 0; j < joints; ++j) {
    int best = 0;
    for (int set = 1; set < sets; ++set)
      if (errors[set].rms()[j] < errors[best].rms()[j]) best = set;
    c.weak.set[j] = best;
    for (int set = best - 1; set >= 0; --set) {
      const Gain loss = gain_of(errors[set], errors[best], j);
      if (loss.mean <= std::max(loss.error, 2.0 * kWindowWorthIt)) c.weak.set[j] = set;
    }
  }
}

}  // namespace

ModelChoice choose_model(const WeakMoments& moments, const ParameterSpace& space,
                         const Eigen::VectorXd& start, const std::vector<bool>& asked,
                         const std::vector<bool>& optional, const ShiftRange& shifts, int sets) {
  const int n = space.joints();
  const Chooser chooser(moments, space, start);
  ModelChoice c;
  c.weak = {std::vector<int>(n, moments.yardstick()), std::vector<int>(n, 0), std::vector<int>(n, 0),
            std::vector<int>(n, kWidths - 1)};
  for (std::size_t p = 0; p < asked.size(); ++p) c.wanted.push_back(asked[p] && !optional[p]);
  choose_shifts(chooser, shifts, n, plain(space, asked), c);
  choose_widths(chooser, n, c);
  choose_terms(chooser, space, asked, optional, c);
  choose_bends(chooser, space, asked, c);
  choose_shifts(chooser, shifts, n, c.wanted, c);
  choose_windows(chooser, sets, n, c);
  const Eigen::VectorXd scale = chooser.scale(c.weak, c.wanted);
  c.held_out = chooser.error(c.weak, c.wanted, scale);
  WeakChoice judged = c.weak;
  judged.set.assign(n, moments.yardstick());
  const Eigen::VectorXd rms = c.held_out.rms(), torque = moments.torque_std(judged);
  for (int j = 0; j < n; ++j)
    c.held_out_r2.push_back(torque[j] > 0.0 ? 1.0 - rms[j] * rms[j] / (torque[j] * torque[j]) : 0.0);
  if (!moments.folds_are_logs()) return c;
  c.spread.resize(space.count(), moments.folds());
  for (int fold = 0; fold < moments.folds(); ++fold)
    c.spread.col(fold) = moments.fit_one(c.weak, c.wanted, start, scale, fold);
  return c;
}

}  // namespace faultline
