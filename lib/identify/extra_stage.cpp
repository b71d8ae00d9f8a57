// SPDX-License-Identifier: MIT
#include "lib/identify/extra_stage.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "lib/identify/extra/find_ripples.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/parameter_space.hpp"

namespace faultline {
namespace {

constexpr double kLooked = 0.005;     // of a joint's torque: a smaller residual needs no extra terms
constexpr double kSharedR2 = 0.998;   // held-out R2 of joints above which no shared drive is tried
constexpr double kLeastAlong = 1e-9;  // of a drive's motion: less belongs to another joint
constexpr int kSettlingRounds = 2;    // renewals of columns that depend on the robot
constexpr double kSlow_s = 0.02;      // samples farther apart show no spring

/// Marks moving joints with significant unexplained torque.
std::vector<bool> unexplained_joints(const Gathered& gathered, const ModelChoice& choice) {
  std::vector<bool> out;
  for (int j = 0; j < static_cast<int>(choice.held_out_r2.size()); ++j)
    out.push_back(!has_joint(gathered.windows.still, Joint::at(j)) &&
                  choice.held_out_r2[j] < 1.0 - kLooked * kLooked);
  return out;
}

/// Returns the drives of the space, those that the robot file couples, and drives of neighbouring joints
/// whose torque is poorly explained: wrists often turn the last motor with the joint before.
std::vector<SharedDrive> drives_to_try(const ParameterSpace& space, const Robot& robot,
                                       const ModelChoice& choice, const std::vector<bool>& look) {
  std::vector<SharedDrive> drives = space.chain.shared_drives;
  const int n = space.joints();
  const auto add = [&](const Eigen::VectorXd& along, int widest) {
    for (const SharedDrive& f : drives)
      if ((f.along - along).norm() < kLeastAlong || (f.along + along).norm() < kLeastAlong) return;
    drives.push_back({along, 0.0, 0.0, weak_width(space, widest, choice.weak.width[widest])});
  };
  if (robot.log.coupling.size() > 0) {
    const Eigen::MatrixXd coupled = robot.log.coupling.inverse();
    for (int k = 0; k < n; ++k)
      if ((coupled.row(k).array().abs() > kLeastAlong).count() > 1) add(coupled.row(k), k);
  }
  for (int j = 0; j + 1 < n; ++j) {
    const bool turn = space.chain.geometry[j].kind == AxisKind::revolute &&
                      space.chain.geometry[j + 1].kind == AxisKind::revolute;
    const double worst = std::min(choice.held_out_r2[j], choice.held_out_r2[j + 1]);
    if (!turn || !look[j] || !look[j + 1] || worst > kSharedR2) continue;
    for (const double sign : {1.0, -1.0})
      add(Eigen::VectorXd::Unit(n, j) + sign * Eigen::VectorXd::Unit(n, j + 1), j + 1);
  }
  return drives;
}

/// Returns the space with all extra terms to be tried.
ParameterSpace with_candidates(const DraftedModel& first, const Robot& robot, const std::vector<bool>& look) {
  const auto& [gathered, draft] = first;
  ParameterSpace space = draft.torque.space;
  space.chain.shared_drives = drives_to_try(space, robot, draft.choice, look);
  for (int j = 0; j < space.joints(); ++j) {
    if (!look[j]) continue;
    const auto found = find_ripples(gathered.windows, draft.choice.weak, draft.torque.fit.parameters, j);
    space.chain.ripples.insert(space.chain.ripples.end(), found.begin(), found.end());
  }
  const bool fast = std::all_of(gathered.surveys.begin(), gathered.surveys.end(),
                                [](const LogSurvey& log) { return log.summary.period_s <= kSlow_s; });
  Chain chain = space.chain;
  std::vector<double> compliance(space.joints(), 0.0);
  for (int j = 0; j < space.joints(); ++j) {
    if (!look[j]) continue;
    if (robot.known.count(fmt::format("fl{}", Joint::at(j))) == 0) chain.friction[j].load = 1.0;
    compliance[j] = fast ? 1.0 : 0.0;
  }
  space.extra = extra_terms_of(chain, compliance);
  return space;
}

/// Maps a vector over the parameters of one space to another space with other extra terms, which get `value`.
template <typename Vector, typename Value>
Vector with_extra(const ParameterSpace& from, const ParameterSpace& to, const Vector& v, Value value) {
  Vector out(to.count());
  for (int p = 0; p < to.count(); ++p)
    out[p] = p < to.extra_begin() ? v[p] : p < to.timing() ? value : v[p - to.timing() + from.timing()];
  return out;
}

/// Returns the extra terms of the space, from 0, whose parameters `stay`.
std::vector<int> kept_terms(const ParameterSpace& space, const std::vector<bool>& stay) {
  std::vector<int> kept;
  for (int i = 0; i < static_cast<int>(space.extra.size()); ++i)
    if (stay[space.extra_begin() + i]) kept.push_back(i);
  return kept;
}

/// Returns the space with only the `kept` ones of its extra terms, from 0.
ParameterSpace pruned(const ParameterSpace& space, const std::vector<int>& kept) {
  ParameterSpace out = space;
  out.extra.clear();
  out.chain.ripples.clear();
  out.chain.shared_drives.clear();
  std::vector<int> ripple(space.chain.ripples.size(), -1), shared(space.chain.shared_drives.size(), -1);
  const auto place = [](auto& from, auto& to, std::vector<int>& at, int index) {
    if (at[index] < 0) {
      at[index] = static_cast<int>(to.size());
      to.push_back(from[index]);
    }
    return at[index];
  };
  for (const int i : kept) {
    ExtraTerm term = space.extra[i];
    if (is_ripple(term.kind)) term.index = place(space.chain.ripples, out.chain.ripples, ripple, term.index);
    if (is_of_shared_drive(term.kind))
      term.index = place(space.chain.shared_drives, out.chain.shared_drives, shared, term.index);
    out.extra.push_back(term);
  }
  return out;
}

/// Returns the terms that are listed: all but rejected candidates, which are many.
std::vector<ModelTerm> listed(std::vector<ModelTerm> terms) {
  std::erase_if(terms, [](const ModelTerm& term) { return !term.kept && term.kind == TermKind::candidate; });
  return terms;
}

/// Keeps load friction that the robot file gives.
ModelDraft hold_known_load(const ParameterSpace& space, const Robot& robot, ModelDraft draft) {
  for (int p = space.extra_begin(); p < space.timing(); ++p) {
    const ExtraTerm& term = space.extra_at(p);
    const auto known = robot.known.find(fmt::format("fl{}", term.joint));
    if (term.kind != ExtraKind::load_friction || known == robot.known.end()) continue;
    draft.wanted.asked[p] = known->second.std > 0.0;
    draft.nominal[p] = known->second.value;
  }
  return draft;
}

/// Maps the vectors of `draft` to the parameters of another space, in which all extra terms are asked for.
/// The torque fit stays as it was.
ModelDraft moved_to(const ParameterSpace& to, const Robot& robot, ModelDraft draft) {
  const ParameterSpace& from = draft.torque.space;
  draft.nominal = with_extra(from, to, draft.nominal, 0.0);
  draft.wanted.asked = with_extra(from, to, draft.wanted.asked, true);
  draft.wanted.optional = with_extra(from, to, draft.wanted.optional, false);
  draft.choice.wanted = with_extra(from, to, draft.choice.wanted, false);
  return hold_known_load(to, robot, std::move(draft));
}

/// Returns the choice after trying the extra terms. No gains are tried if logs have payloads: these logs are
/// fitted apart and must use the same gains.
ModelChoice try_candidates(const Gathered& gathered, const Robot& robot, const ModelDraft& draft) {
  const ParameterSpace& space = gathered.windows.space;
  const Chooser chooser(gathered.windows, nominal_timing(robot), draft.nominal);
  ModelChoice c = draft.choice;
  c.terms.clear();
  c.weak.set.assign(space.joints(), chooser.yardstick());
  c = choose_extra(chooser, draft.wanted.asked, std::move(c));
  std::vector<bool> counts;
  for (int j = 0; j < space.joints(); ++j) counts.push_back(!has_joint(gathered.windows.still, Joint::at(j)));
  if (robot.payloads.empty()) c = choose_gains(chooser, counts, std::move(c));
  for (int p = space.extra_begin(); p < space.timing(); ++p)
    c.wanted[p] = c.wanted[p] || draft.nominal[p] != 0.0;
  return c;
}

/// Renews the columns of load friction and springs with the robot as fitted, since they were computed without
/// both and with other gains, and fits the torque again.
DraftedModel settle_columns(std::span<LogSource* const> logs, const Robot& robot, DraftedModel model) {
  auto& [gathered, draft] = model;
  const ParameterSpace space = draft.torque.space;
  const bool depend = std::any_of(space.extra.begin(), space.extra.end(), [](const ExtraTerm& term) {
    return term.kind == ExtraKind::load_friction || term.kind == ExtraKind::gear_compliance;
  });
  for (int round = 0; depend && round < kSettlingRounds; ++round) {
    const Eigen::VectorXd& fitted = draft.torque.fit.parameters;
    const double phi = std::clamp(fitted[space.timing()], 0.0, 1.0);
    gathered = gather_again(logs, space, {draft.torque.shift, phi, fitted}, std::move(gathered));
    draft.torque = fit_torque(gathered, draft.choice, draft.nominal, robot, space);
  }
  return model;
}

/// Chooses the model in another space and fits its torque.
DraftedModel choose_again(std::span<LogSource* const> logs, const ParameterSpace& space, const Robot& robot,
                          DraftedModel model) {
  auto& [gathered, draft] = model;
  draft = moved_to(space, robot, std::move(draft));
  draft.choice = choose_model(gathered.windows, nominal_timing(robot), draft.nominal, draft.wanted);
  draft.torque = fit_torque(gathered, draft.choice, draft.nominal, robot, space);
  return settle_columns(logs, robot, std::move(model));
}

}  // namespace

double nominal_timing(const Robot& robot) {
  if (robot.log.torque_between_samples == TorqueTiming::held) return 0.0;
  return robot.torque_phi.value_or(0.5);
}

DraftedModel take_extra_terms(std::span<LogSource* const> logs, const Robot& robot, DraftedModel first) {
  auto& [gathered, draft] = first;
  const std::vector<bool> look = unexplained_joints(gathered, draft.choice);
  if (std::count(look.begin(), look.end(), true) == 0) return first;
  const ParameterSpace wide = with_candidates(first, robot, look);
  const double phi = std::clamp(draft.torque.fit.parameters[draft.torque.space.timing()], 0.0, 1.0);
  const ExtraSetting setting{draft.torque.shift, phi, draft.torque.fit.parameters};
  gathered = gather_again(logs, wide, setting, std::move(gathered));
  const ModelChoice tried = try_candidates(gathered, robot, moved_to(wide, robot, draft));

  const std::vector<double>& gain = tried.weak.gain;
  const bool scales = std::any_of(gain.begin(), gain.end(), [](double g) { return g != 1.0; });
  const std::vector<int> kept = kept_terms(wide, tried.wanted);
  const ParameterSpace space = pruned(wide, kept);
  if (scales) {
    gathered.torque_gain = gain;
    gathered = gather_again(logs, space, setting, std::move(gathered));
  } else {
    for (WeakWindows& set : gathered.windows.sets) set.keep_extra(kept);
    gathered.windows.space = space;
  }
  const bool as_before = kept.empty() && draft.torque.space.extra.empty() && !scales;
  DraftedModel out = as_before ? std::move(first) : choose_again(logs, space, robot, std::move(first));
  const std::vector<ModelTerm> terms = listed(tried.terms);
  out.draft.choice.terms.insert(out.draft.choice.terms.end(), terms.begin(), terms.end());
  return out;
}

}  // namespace faultline
