// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/golden_section.hpp"
#include "lib/identify/weak_form/weak_choice.hpp"

namespace faultline {
namespace {

constexpr LeastGain kLoad{.residual = 0.1, .torque = 1e-3};    // load friction: one column
constexpr LeastGain kShared{.residual = 0.2, .torque = 1e-3};  // drives that joints share: three columns
// Play, or a spring in a neighbour, looks similar.
constexpr LeastGain kCompliance{.residual = 0.3, .torque = 1e-3, .sure = 2.0};
// Fast terms are judged by the shortest windows, where noise of the velocity dominates the residual.
constexpr LeastGain kQuick{.residual = 0.1, .torque = 1e-3, .sure = 2.0};
// A wrong gain makes the masses wrong.
constexpr LeastGain kChoiceGain{.residual = 0.12, .torque = 2e-3, .sure = 3.0};
constexpr double kMostGain = 2.0;     // largest gain; the smallest is its inverse
constexpr int kGainSteps = 14;        // steps between the two, at first
constexpr int kGainRefinements = 12;  // steps of the golden section: they determine the gain to 0.06 %

/// Terms that are tried together.
struct TermGroup {
  std::vector<int> parameters;
  std::vector<Joint> joints;  ///< those that they act on
  LeastGain worth{};
  bool quick = false;
  double promise = 0.0;   ///< gain by the group alone
  Joint joint = 1_joint;  ///< that gains most; the first one if none gains
  HeldOutError without{}, with{};
};

bool is_quick(ExtraKind kind) { return is_ripple(kind) || kind == ExtraKind::gear_compliance; }

std::vector<Joint> joints_of(const ParameterSpace& space, const ExtraTerm& term) {
  if (!is_of_shared_drive(term.kind)) return {term.joint};
  std::vector<Joint> joints;
  for (int j = 0; j < space.joints(); ++j)
    if (space.chain.shared_drives[term.index].along[j] != 0.0) joints.push_back(Joint::at(j));
  return joints;
}

std::vector<TermGroup> groups_of(const ParameterSpace& space, const std::vector<bool>& asked) {
  std::vector<TermGroup> groups;
  for (int p = space.extra_begin(); p < space.timing(); ++p) {
    const ExtraTerm& term = space.extra_at(p);
    if (!asked[p]) continue;
    if (!groups.empty() && belong_together(term, space.extra_at(groups.back().parameters.back()))) {
      groups.back().parameters.push_back(p);
      continue;
    }
    const LeastGain& worth = term.kind == ExtraKind::gear_compliance ? kCompliance
                             : is_quick(term.kind)                   ? kQuick
                             : is_of_shared_drive(term.kind)         ? kShared
                                                                     : kLoad;
    groups.push_back(
        {.parameters = {p}, .joints = joints_of(space, term), .worth = worth, .quick = is_quick(term.kind)});
  }
  return groups;
}

std::vector<bool> with_group(std::vector<bool> wanted, const TermGroup& group) {
  for (const int p : group.parameters) wanted[p] = true;
  return wanted;
}

/// Returns the group with its gain beside the present choice.
TermGroup judged(const Chooser& chooser, const ModelChoice& c, TermGroup group) {
  const Eigen::VectorXd scale = chooser.scale(c.weak, c.wanted);
  const auto error = [&](const std::vector<bool>& wanted) {
    return chooser.error(c.weak, wanted, scale, group.quick);
  };
  group.without = error(c.wanted);
  group.with = error(with_group(c.wanted, group));
  group.promise = -1.0;
  for (const Joint j : group.joints)
    if (const double gain = gain_of(group.without, group.with, j.index()).mean; gain > group.promise)
      group.promise = gain, group.joint = j;
  return group;
}

/// Whether the fit of a group of a single term is physically possible; of larger groups, single terms may
/// vanish.
bool can_be(const Chooser& chooser, const ModelChoice& c, const TermGroup& group) {
  if (group.parameters.size() > 1) return true;
  const std::vector<bool> wanted = with_group(c.wanted, group);
  const int p = group.parameters.front();
  return is_possible(chooser.space().extra_at(p).kind,
                     chooser.fit(c.weak, wanted, chooser.scale(c.weak, wanted))[p]);
}

/// Returns the logarithm of the gain of joint `j` with the smallest residual.
double best_gain(const Chooser& chooser, const ModelChoice& c, int j) {
  const Eigen::VectorXd scale = chooser.scale(c.weak, c.wanted);
  const double most = elementary::log(kMostGain), step = 2.0 * most / kGainSteps;
  const auto left_with = [&](double log_gain) {
    WeakChoice tried = c.weak;
    tried.gain[j] = elementary::exp(log_gain);
    return chooser.left(tried, c.wanted, scale);
  };
  double best = 0.0, least = left_with(0.0);
  for (int i = 0; i <= kGainSteps; ++i) {
    const double left = left_with(-most + i * step);
    if (left < least) least = left, best = -most + i * step;
  }
  return golden_section(best - step, best + step, kGainRefinements, left_with);
}

}  // namespace

ModelChoice choose_extra(const Chooser& chooser, const std::vector<bool>& asked, ModelChoice c) {
  const ParameterSpace& space = chooser.space();
  std::vector<TermGroup> groups = groups_of(space, asked);
  for (TermGroup& group : groups) group = judged(chooser, c, std::move(group));
  std::stable_sort(groups.begin(), groups.end(),
                   [](const TermGroup& a, const TermGroup& b) { return a.promise > b.promise; });
  bool changed = false;
  for (TermGroup& group : groups) {
    if (changed) group = judged(chooser, c, std::move(group));
    const int j = group.joint.index();
    bool kept = pays(group.without, group.with, j, chooser.torque(c.weak)[j], group.worth);
    for (const Joint other : group.joints)
      kept = kept && !pays(group.with, group.without, other.index(), chooser.torque(c.weak)[other.index()],
                           group.worth);
    kept = kept && can_be(chooser, c, group);
    const ExtraKind kind = space.extra_at(group.parameters.front()).kind;
    const bool many = is_ripple(kind) || is_of_shared_drive(kind);
    c.terms.push_back({space.name(group.parameters.front()), group.joint, kept, group.without.rms()[j],
                       group.with.rms()[j], many ? TermKind::candidate : TermKind::parameter});
    if (kept) c.wanted = with_group(c.wanted, group);
    changed = changed || kept;
  }
  return c;
}

ModelChoice choose_gains(const Chooser& chooser, const std::vector<bool>& counts, ModelChoice c) {
  const int n = static_cast<int>(counts.size());
  const int first = static_cast<int>(std::find(counts.begin(), counts.end(), true) - counts.begin());
  if (c.weak.gain.empty()) c.weak.gain.assign(n, 1.0);
  const Eigen::VectorXd torque = chooser.torque(c.weak);
  for (int j = first + 1; j < n; ++j) {
    if (!counts[j]) continue;
    const double gain = elementary::exp(best_gain(chooser, c, j));
    if (!(gain < 0.95 * kMostGain && gain > 1.05 / kMostGain)) continue;
    WeakChoice tried = c.weak;
    tried.gain[j] = gain;
    const HeldOutError without = chooser.error(c.weak, c.wanted), with = chooser.error(tried, c.wanted);
    int best = j;
    bool kept = false, harms = false;
    for (int k = 0; k < n; ++k) {
      if (!counts[k]) continue;
      kept = kept || pays(without, with, k, torque[k], kChoiceGain);
      harms = harms || pays(with, without, k, torque[k], kChoiceGain);
      if (gain_of(without, with, k).mean > gain_of(without, with, best).mean) best = k;
    }
    kept = kept && !harms;
    c.terms.push_back({fmt::format("torque_gain_{}", Joint::at(j)), Joint::at(best), kept,
                       without.rms()[best], with.rms()[best], TermKind::candidate});
    if (kept) c.weak = tried;
  }
  return c;
}

}  // namespace faultline
