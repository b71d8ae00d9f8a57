// SPDX-License-Identifier: MIT
#include "lib/identify/fit_alike.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/make_issue.hpp"
#include "lib/core/statistics.hpp"
#include "lib/identify/extra_stage.hpp"
#include "lib/identify/gathered.hpp"
#include "lib/identify/interpretation/reinterpretation.hpp"
#include "lib/identify/parameter_table.hpp"
#include "lib/identify/shooting_stage.hpp"
#include "lib/identify/torque_fit.hpp"
#include "lib/identify/verdict/confounded_parameters.hpp"
#include "lib/identify/verdict/fit_verdict.hpp"
#include "lib/identify/wanted_parameters.hpp"
#include "lib/identify/weak_form/weak_choice.hpp"

namespace faultline {
namespace {

constexpr double kGood = 0.97;  // least explained share of a joint's torque: below, other columns are tried
constexpr double kWorthShooting = 0.95;  // of every joint's torque: below, the motion is not fitted

constexpr int kFewestLogs = 3;         // if two logs disagree, neither is the odd one
constexpr double kOutlierRatio = 4.0;  // times the residual of the other logs, in rms and as a share,
constexpr double kOutlierShare =
    0.01;  // and at least this share of its mean square: days of a robot differ too

std::vector<double> list(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

void take_noise(const Eigen::VectorXd& noise, bool has_dq, Identification& id) {
  id.q_noise = list(noise.head(id.space.joints()));
  if (has_dq) id.dq_noise = list(noise.tail(id.space.joints()));
}

void take_torque_fit(const TorqueFit& torque, const Gathered& gathered, Identification& id) {
  id.method = IdentifyMethod::weak_form;
  id.status = IdentificationStatus::converged;
  id.estimate = torque.fit.parameters;
  id.covariance = torque.fit.covariance;
  take_noise(gathered.measurements.noise(), gathered.measurements.has_dq(), id);
  id.reason = fmt::format("{} windows", torque.fit.windows);
}

void take_shooting(const ShootingFit& shot, const Gathered& gathered, Identification& id) {
  id.method = IdentifyMethod::output_error;
  id.status = shot.converged ? IdentificationStatus::converged : IdentificationStatus::not_converged;
  id.reason = shot.reason;
  id.estimate = shot.parameters;
  id.covariance = shot.covariance;
  take_noise(shot.noise, gathered.measurements.has_dq(), id);
}

/// Widens friction to the width of the robot file: sharp friction suits the regression, not simulation.
void smooth_friction(const Eigen::VectorXd& nominal, ParameterSpace& space, Eigen::VectorXd& parameters) {
  for (int j = 0; j < space.joints(); ++j) {
    double& width = parameters[space.log_width(j)];
    width = std::max(width, nominal[space.log_width(j)]);
    for (SharedDrive& f : space.chain.shared_drives)
      if (f.along[j] != 0.0) f.width = std::max(f.width, elementary::exp(nominal[space.log_width(j)]));
  }
}

/// Returns the logs, from 0, whose residual with a fit to the others is far larger than that of the others:
/// another robot, another load, or a fault. Never half of them or more; none if folds are not logs.
std::vector<int> outlier_logs(const ModelChoice& choice) {
  std::vector<int> odd;
  const HeldOutError& e = choice.held_out;
  const int logs = static_cast<int>(e.square.rows());
  if (choice.spread.size() == 0 || logs < kFewestLogs) return odd;
  for (int i = 0; i < logs; ++i)
    for (int j = 0; j < static_cast<int>(e.square.cols()); ++j) {
      std::vector<double> left, share;
      for (int k = 0; k < logs; ++k)
        if (k != i && e.rows(k, j) > 0.0) {
          left.push_back(e.square(k, j));
          share.push_back(e.square(k, j) / std::max(e.torque(k, j), 1e-300));
        }
      if (left.empty() || e.rows(i, j) == 0.0) continue;
      const double own_share = e.square(i, j) / std::max(e.torque(i, j), 1e-300);
      if (e.square(i, j) > kOutlierRatio * kOutlierRatio * upper_median(left) && own_share > kOutlierShare &&
          own_share > kOutlierRatio * kOutlierRatio * upper_median(share)) {
        odd.push_back(i);
        break;
      }
    }
  if (2 * odd.size() >= static_cast<std::size_t>(logs)) odd.clear();
  return odd;
}

/// Returns the logs, from 0, that repeat another byte for byte; marks them as left out, with an issue.
std::vector<int> repeated_logs(Identification& id) {
  std::vector<int> repeated;
  for (std::size_t i = 0; i < id.logs.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      if (id.logs[i].sha256.empty() || id.logs[i].sha256 != id.logs[k].sha256 || id.logs[k].left_out)
        continue;
      repeated.push_back(static_cast<int>(i));
      id.logs[i].left_out = true;
      id.issues.add(make_issue(fmt::format("repeated_log_{}", i + 1), Severity::warning,
                               fmt::format("{} is identical to {}, byte for byte; it was left out",
                                           id.logs[i].path, id.logs[k].path)));
      break;
    }
  return repeated;
}

/// Computes how much logs differ: the standard deviation between fits to single logs, by parameter.
void store_spread(const ModelChoice& choice, Identification& id) {
  id.between_logs_std.assign(id.space.count(), std::numeric_limits<double>::quiet_NaN());
  std::vector<int> used;
  for (int log = 0; log < static_cast<int>(choice.spread.cols()); ++log)
    if (!id.logs[log].left_out) used.push_back(log);
  if (used.size() < kFewestLogs) return;
  for (int p = 0; p < id.space.timing(); ++p) {
    if (!choice.wanted[p]) continue;
    const Eigen::ArrayXd values = choice.spread.row(p)(used);
    id.between_logs_std[p] =
        std::sqrt((values - values.mean()).square().sum() / static_cast<double>(used.size() - 1));
  }
}

void name_outlier_logs(const std::vector<int>& odd, bool kept, Identification& id) {
  for (const int log : odd) {
    id.logs[log].left_out = !kept;
    id.issues.add(make_issue(fmt::format("odd_log_{}", log + 1), Severity::warning,
                             fmt::format("{} disagrees with the other logs: a fit to the others has a far "
                                         "larger torque residual in this log; {}",
                                         id.logs[log].path,
                                         kept ? "it was kept, as --keep-all demands"
                                              : "it was left out (--keep-all keeps it). Check whether it "
                                                "shows another robot, another load, or a fault")));
  }
}

/// Searches another interpretation of the columns if the robot explains the logs poorly or is infeasible.
void search_interpretation(std::span<LogSource* const> logs, const std::vector<LogSurvey>& surveys,
                           const std::vector<int>& still, bool infeasible, Identification& id) {
  bool poor = false;
  for (std::size_t j = 0; j < id.fit_r2.size(); ++j)
    if (std::count(still.begin(), still.end(), static_cast<int>(j) + 1) == 0)
      poor = poor || !(id.fit_r2[j] > kGood);
  for (int j = 0; j < id.space.joints(); ++j) {
    const auto found = std::find_if(surveys.begin(), surveys.end(),
                                    [j](const LogSurvey& log) { return log.velocity[j].disagrees(); });
    if (found == surveys.end()) continue;
    id.status = IdentificationStatus::unexplained;
    id.reason += "; " + disagreement_text(found->velocity[j], j + 1);
  }
  if (!poor && !infeasible) return;
  const Reinterpretation found = find_reinterpretation(logs, id.robot);
  if (found.what.empty()) return;
  id.status = IdentificationStatus::unexplained;
  id.reason += fmt::format("; it looks as if {}", found.what);
  id.issues.add(
      make_issue("misread_columns", Severity::severe,
                 fmt::format("it looks as if {}: with that interpretation the robot explains at least {:.1f} "
                             "% of every joint's torque, with the present one {}; {}",
                             found.what, 100.0 * found.r2_after,
                             found.r2_before > 0.0 ? fmt::format("{:.1f} %", 100.0 * found.r2_before)
                                                   : std::string("none of it"),
                             found.cure)));
}

/// Whether a gear was found to be a spring, so that the motion is not that of rigid gears.
bool has_compliant_gear(const ParameterSpace& space, const TorqueFit& torque) {
  for (int p = space.extra_begin(); p < space.timing(); ++p)
    if (torque.wanted[p] && space.extra_at(p).kind == ExtraKind::gear_compliance) return true;
  return false;
}

/// Takes the fit of the motion if it is accepted or asked for, else that of the torque balance.
void settle_method(std::span<LogSource* const> logs, const Gathered& gathered, TorqueFit& torque,
                   const Eigen::VectorXd& nominal, const IdentifyOptions& options, const Progress& progress,
                   Identification& id) {
  const std::vector<bool>& still = gathered.windows.still;
  const bool moves = std::count(still.begin(), still.end(), true) == 0;  // all joints move, else M is unknown
  double worst = 1.0;
  for (int j = 0; j < id.space.joints(); ++j)
    if (!still[j]) worst = std::min(worst, torque.fit.r2[j]);
  if (options.method == IdentifyMethod::automatic && worst < kWorthShooting) {
    id.issues.add(
        make_issue("torque_unexplained", Severity::note,
                   fmt::format("the model explains only {:.1f} % of some joint's torque: its motion was not "
                               "fitted",
                               100.0 * std::max(worst, 0.0))));
  } else if (options.method == IdentifyMethod::automatic && has_compliant_gear(id.space, torque)) {
    id.issues.add(make_issue("gear_compliance", Severity::note,
                             "a gear is elastic: values and intervals come from the momentum balance, the "
                             "motion with rigid gears was not fitted"));
  } else if (options.method != IdentifyMethod::weak_form && moves) {
    TorqueFit start = torque;
    for (int j = 0; j < id.space.joints(); ++j)
      start.fit.parameters[id.space.log_width(j)] = nominal[id.space.log_width(j)];
    const ShootingOutcome shot = shoot(logs, gathered, start, id, options, progress);
    const bool forced = options.method == IdentifyMethod::output_error && shot.fit.parameters.size() > 0;
    if (shot.refused.empty() || forced) {
      take_shooting(shot.fit, gathered, id);
      return;
    }
    id.issues.add(make_issue("model_error", Severity::note,
                             shot.refused +
                                 "; values and intervals come from the momentum balance over short "
                                 "windows instead of the output error"));
  }
  take_torque_fit(torque, gathered, id);
}

/// Marks the chosen terms that the last fit dropped.
void settle_terms(const ParameterSpace& space, ModelDraft& draft) {
  const auto left = [&](int p) {
    bool any = draft.torque.wanted[p];
    for (int k = space.extra_begin(); k < space.timing(); ++k)
      if (belong_together(space.extra_at(k), space.extra_at(p))) any = any || draft.torque.wanted[k];
    return any;
  };
  for (ModelTerm& term : draft.choice.terms) {
    if (term.kind == TermKind::delay) term.kept = draft.torque.shift[term.joint] != 0;
    for (int p = space.extra_begin(); p < space.timing(); ++p)
      if (term.kept && term.name == space.name(p)) term.kept = left(p);
  }
}

/// Chooses the model from the logs and fits its torque.
ModelDraft draft_model(std::span<LogSource* const> logs, Gathered& gathered, const std::vector<int>& still,
                       const IdentifyOptions& options, Identification& id) {
  ModelDraft draft;
  draft.nominal = parameters_of(id.space, id.robot.chain, nominal_timing(id.robot));
  draft.wanted = wanted_parameters(id.space, id.robot, still, options.estimate_offset && has_fast_log(id));
  for (int p = id.space.bend(0); p < id.space.timing(); ++p)
    if (draft.wanted.asked[p]) draft.nominal[p] = 0.0;
  const auto choose = [&] {
    return choose_model(WeakMoments(gathered.windows, nominal_timing(id.robot)), id.space, draft.nominal,
                        draft.wanted.asked, draft.wanted.optional, gathered.windows.shifts,
                        static_cast<int>(gathered.windows.sets.size()));
  };
  gathered.leave_out(repeated_logs(id));
  draft.choice = choose();
  if (const std::vector<int> odd = outlier_logs(draft.choice); !odd.empty()) {
    name_outlier_logs(odd, options.keep_all, id);
    if (!options.keep_all) {
      gathered.leave_out(odd);
      draft.choice = choose();
    }
  }
  draft.torque = fit_torque(gathered, draft.choice, draft.nominal, id.robot, id.space);
  take_extra_terms(logs, gathered, id, draft);
  draft.choice.weak.shift = draft.torque.shift;
  settle_terms(id.space, draft);
  if (!draft.torque.why_infeasible.empty())
    id.issues.add(make_issue("infeasible", Severity::warning,
                             draft.torque.why_infeasible +
                                 ", which is infeasible; the nearest feasible robot was used instead: "
                                 "these logs do not determine values next to that bound"));
  return draft;
}

/// Stores what is not in the equations of motion: the torque gains of the log and the compliance of gears.
void store_drives(const Gathered& gathered, const Eigen::VectorXd& parameters, Identification& id) {
  const int n = id.space.joints();
  if (!gathered.torque_gain.empty()) {
    id.robot.torque_gain.resize(n, 1.0);
    for (int j = 0; j < n; ++j) {
      id.robot.torque_gain[j] *= gathered.torque_gain[j];
      if (gathered.torque_gain[j] == 1.0) continue;
      id.issues.add(make_issue(
          fmt::format("torque_gain_{}", j + 1), Severity::warning,
          fmt::format("the torque of joint {} is {:.3f} times the value in its column, according to the "
                      "masses that it shares with the joints before: check its unit, torque constant and "
                      "gear ratio. The identified robot applies this factor (torque_gain)",
                      j + 1, gathered.torque_gain[j])));
    }
  }
  id.robot.gear_compliance.clear();
  for (int p = id.space.extra_begin(); p < id.space.timing(); ++p) {
    const ExtraTerm& term = id.space.extra_at(p);
    if (term.kind != ExtraKind::gear_compliance) continue;
    id.robot.gear_compliance.resize(n, 0.0);
    id.robot.gear_compliance[term.joint] = parameters[p];
  }
}

}  // namespace

AlikeFit fit_alike(std::span<LogSource* const> logs, const Robot& robot, const IdentifyOptions& options,
                   const Progress& progress) {
  AlikeFit fit;
  Identification& id = fit.id;
  id.robot = robot;
  id.space = parameter_space(robot);
  Gathered gathered = gather(logs, options.window_s, options.max_windows, progress, id);
  const std::vector<int> still = unmoved_joints(gathered.measurements, id.space);
  gathered.leave_out_joints(still);
  ModelDraft draft = draft_model(logs, gathered, still, options, id);
  TorqueFit& torque = draft.torque;
  settle_method(logs, gathered, torque, draft.nominal, options, progress, id);
  store_drives(gathered, torque.fit.parameters, id);

  const std::vector<int> undriven = undriven_joints(id.space, torque);
  const Confounded confounded = confounded_parameters(id.space, robot, still, undriven, torque);
  const std::vector<int>& leaning = confounded.leaning;
  torque.fit.confounded = confounded.parameters;
  id.condition_number = torque.fit.condition_number;
  judge_fit(torque, draft.choice, gathered, still, undriven, id);
  store_spread(draft.choice, id);
  const bool is_infeasible = !torque.why_infeasible.empty();
  search_interpretation(logs, gathered.surveys, still, is_infeasible, id);
  if (id.method == IdentifyMethod::weak_form) smooth_friction(draft.nominal, id.space, id.estimate);
  id.base_parameters =
      base_parameter_table(torque.fit, {torque.wanted, still, undriven, leaning, has_fast_log(id)}, id);
  if (is_infeasible && id.status == IdentificationStatus::converged) {
    id.status = IdentificationStatus::poorly_excited;
    id.reason += "; the best fit is infeasible: no real robot has these parameters";
  }
  if (!all_identifiable(id) && id.status == IdentificationStatus::converged) {
    id.status = IdentificationStatus::poorly_excited;
    id.reason += "; " + why_not_identifiable(still, undriven, leaning);
  }
  for (int p = 0; p < id.space.rigid(); ++p)
    fit.usable.push_back(torque.fit.free[p] && !torque.fit.confounded[p]);
  return fit;
}

}  // namespace faultline
