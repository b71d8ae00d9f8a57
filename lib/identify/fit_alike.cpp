// SPDX-License-Identifier: MIT
#include "lib/identify/fit_alike.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/statistics.hpp"
#include "lib/identify/extra_stage.hpp"
#include "lib/identify/gathered.hpp"
#include "lib/identify/interpretation/reinterpretation.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/identify/parameter_table.hpp"
#include "lib/identify/shooting_stage.hpp"
#include "lib/identify/torque_fit.hpp"
#include "lib/identify/verdict/fit_verdict.hpp"
#include "lib/identify/weak_form/weak_choice.hpp"

namespace faultline {
namespace {

constexpr double kGood = 0.97;  // least explained share of a joint's torque: below, other columns are tried
constexpr double kShortestWindow_s = 0.04;  // of the weak form; at least one sample
constexpr int kMostWindows = 6000;          // that the weak form keeps, spread over all logs
constexpr double kWorthShooting = 0.95;     // of every joint's torque: below, the motion is not fitted

constexpr int kFewestLogs = 3;         // if two logs disagree, neither is the odd one
constexpr double kOutlierRatio = 4.0;  // times the residual of the other logs, in rms and as a share,
constexpr double kOutlierShare =
    0.01;  // and at least this share of its mean square: days of a robot differ too

std::vector<double> list(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

/// Returns the identification with the values of one method. `noise`: std of q, then of dq, by joint.
Identification with_values(IdentifyMethod method, FitStatus status, const Eigen::VectorXd& estimate,
                           const Eigen::MatrixXd& covariance, const Eigen::VectorXd& noise, bool has_dq,
                           Identification id) {
  id.method = method;
  id.status = status.status;
  id.reason = std::move(status.reason);
  id.estimate = estimate;
  id.covariance = covariance;
  id.q_noise = list(noise.head(id.space.joints()));
  if (has_dq) id.dq_noise = list(noise.tail(id.space.joints()));
  return id;
}

/// Returns the identification with friction at least as wide as in the robot file, that of shared drives,
/// too: sharp friction suits the regression, not simulation.
Identification with_smooth_friction(const Eigen::VectorXd& nominal, Identification id) {
  for (int j = 0; j < id.space.joints(); ++j) {
    const int width = id.space.log_width(j);
    id.estimate[width] = std::max(id.estimate[width], nominal[width]);
    for (SharedDrive& f : id.space.chain.shared_drives)
      if (f.along[j] != 0.0) f.width = std::max(f.width, elementary::exp(nominal[width]));
  }
  return id;
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

/// Returns the logs, from 0, that repeat an earlier one byte for byte; adds an issue for each.
std::vector<int> repeated_logs(const std::vector<IdentifiedLog>& logs, Issues& issues) {
  std::vector<int> repeated;
  for (auto log = logs.begin(); log != logs.end(); ++log) {
    const auto earlier = std::find_if(
        logs.begin(), log, [&](const IdentifiedLog& other) { return other.sha256 == log->sha256; });
    if (log->sha256.empty() || earlier == log) continue;
    repeated.push_back(static_cast<int>(log - logs.begin()));
    issues.add(make_issue(
        fmt::format("repeated_log_{}", repeated.back() + 1), Severity::warning,
        fmt::format("{} is identical to {}, byte for byte; it was left out", log->path, earlier->path)));
  }
  return repeated;
}

Issue outlier_issue(int log, const std::string& path, bool kept) {
  return make_issue(fmt::format("odd_log_{}", log + 1), Severity::warning,
                    fmt::format("{} disagrees with the other logs: a fit to the others has a far "
                                "larger torque residual in this log; {}",
                                path,
                                kept ? "it was kept, as --keep-all demands"
                                     : "it was left out (--keep-all keeps it). Check whether it "
                                       "shows another robot, another load, or a fault"));
}

/// Returns the identification with what contradicts the columns of the logs: a velocity that is not that of
/// its position or, if the robot explains the logs poorly or is infeasible, another interpretation that
/// explains the torque.
Identification with_judged_columns(std::span<LogSource* const> logs, const Gathered& gathered,
                                   bool is_infeasible, Identification id) {
  bool is_poor = is_infeasible;
  for (int j = 0; j < id.space.joints(); ++j) {
    is_poor = is_poor || (!has_joint(gathered.windows.still, Joint::at(j)) && !(id.fit_r2[j] > kGood));
    const auto found = std::find_if(gathered.surveys.begin(), gathered.surveys.end(),
                                    [j](const LogSurvey& log) { return log.velocity[j].is_other_unit(); });
    if (found != gathered.surveys.end())
      id.take(
          FitStatus{IdentificationStatus::unexplained, other_unit_text(found->velocity[j], Joint::at(j))});
  }
  if (!is_poor) return id;
  const Reinterpretation found = find_reinterpretation(logs, id.robot);
  if (found.what.empty()) return id;
  id.take(FitStatus{IdentificationStatus::unexplained, fmt::format("it looks as if {}", found.what)});
  id.issues.add(
      make_issue("misread_columns", Severity::severe,
                 fmt::format("it looks as if {}: with that interpretation the robot explains at least {:.1f} "
                             "% of every joint's torque, with the present one {}; {}",
                             found.what, 100.0 * found.r2_after,
                             found.r2_before > 0.0 ? fmt::format("{:.1f} %", 100.0 * found.r2_before)
                                                   : std::string("none of it"),
                             found.cure)));
  return id;
}

/// Whether a gear was found to be a spring, so that the motion is not that of rigid gears.
bool has_compliant_gear(const ParameterSpace& space, const TorqueFit& torque) {
  for (int p = space.extra_begin(); p < space.timing(); ++p)
    if (torque.wanted[p] && space.extra_at(p).kind == ExtraKind::gear_compliance) return true;
  return false;
}

/// Returns the identification with the fit of the motion if it is accepted or asked for, else with that of
/// the torque balance.
Identification with_settled_method(std::span<LogSource* const> logs, const DraftedModel& model,
                                   const IdentifyOptions& options, const Progress& progress,
                                   Identification id) {
  const TorqueFit& torque = model.draft.torque;
  const Eigen::VectorXd& nominal = model.draft.nominal;
  const std::vector<Joint>& still = model.gathered.windows.still;
  const bool has_dq = model.gathered.measurements.has_dq(), all_move = still.empty();  // else M is unknown
  double worst = 1.0;
  for (int j = 0; j < id.space.joints(); ++j)
    if (!has_joint(still, Joint::at(j))) worst = std::min(worst, torque.fit.r2[j]);
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
  } else if (options.method != IdentifyMethod::weak_form && all_move) {
    TorqueFit start = torque;
    for (int j = 0; j < id.space.joints(); ++j)
      start.fit.parameters[id.space.log_width(j)] = nominal[id.space.log_width(j)];
    const ShootingOutcome shot = shoot(logs, model.gathered, start, id, options, progress);
    const ShootingFit& fit = shot.fit;
    const bool forced = options.method == IdentifyMethod::output_error && fit.parameters.size() > 0;
    if (shot.refused.empty() || forced) {
      const auto status =
          fit.converged ? IdentificationStatus::converged : IdentificationStatus::not_converged;
      return with_values(IdentifyMethod::output_error, {status, fit.reason}, fit.parameters, fit.covariance,
                         fit.noise, has_dq, std::move(id));
    }
    id.issues.add(make_issue("model_error", Severity::note,
                             shot.refused +
                                 "; values and intervals come from the momentum balance over short "
                                 "windows instead of the output error"));
  }
  return with_values(IdentifyMethod::weak_form,
                     {IdentificationStatus::converged, fmt::format("{} windows", torque.fit.windows)},
                     torque.fit.parameters, torque.fit.covariance, model.gathered.measurements.noise(),
                     has_dq, std::move(id));
}

/// Returns the chosen terms, those that the last fit dropped as not kept.
std::vector<ModelTerm> settled_terms(const ModelDraft& draft) {
  const ParameterSpace& space = draft.torque.space;
  const auto left = [&](int p) {
    bool any = draft.torque.wanted[p];
    for (int k = space.extra_begin(); k < space.timing(); ++k)
      if (belong_together(space.extra_at(k), space.extra_at(p))) any = any || draft.torque.wanted[k];
    return any;
  };
  std::vector<ModelTerm> terms = draft.choice.terms;
  for (ModelTerm& term : terms) {
    if (term.kind == TermKind::delay) term.kept = draft.torque.shift[term.joint.index()] != 0;
    for (int p = space.extra_begin(); p < space.timing(); ++p)
      if (term.kept && term.name == space.name(p)) term.kept = left(p);
  }
  return terms;
}

/// Chooses the model from the logs and fits its torque; logs that repeat or contradict others are left out.
/// `issues` get what was noticed about the logs.
DraftedModel draft_model(std::span<LogSource* const> logs, Gathered gathered, const IdentifyOptions& options,
                         const Identification& id, Issues& issues) {
  ModelDraft draft;
  draft.nominal = parameters_of(id.space, id.robot.chain, nominal_timing(id.robot));
  draft.wanted = wanted_parameters(id.space, id.robot, gathered.windows.still, has_fast_log(id));
  for (int p = id.space.bend(0); p < id.space.timing(); ++p)
    if (draft.wanted.asked[p]) draft.nominal[p] = 0.0;
  const auto choose = [&] {
    return choose_model(gathered.windows, nominal_timing(id.robot), draft.nominal, draft.wanted);
  };
  gathered.leave_out(repeated_logs(id.logs, issues));
  draft.choice = choose();
  if (const std::vector<int> odd = outlier_logs(draft.choice); !odd.empty()) {
    for (const int log : odd) issues.add(outlier_issue(log, id.logs[log].path, options.keep_all));
    if (!options.keep_all) {
      gathered.leave_out(odd);
      draft.choice = choose();
    }
  }
  draft.torque = fit_torque(gathered, draft.choice, draft.nominal, id.robot, id.space);
  DraftedModel model = take_extra_terms(logs, id.robot, {std::move(gathered), std::move(draft)});
  model.draft.choice.weak.shift = model.draft.torque.shift;
  model.draft.choice.terms = settled_terms(model.draft);
  if (const std::string& why = model.draft.torque.why_infeasible; !why.empty())
    issues.add(make_issue("infeasible", Severity::warning,
                          why + ", which is infeasible; the nearest feasible robot was used instead: "
                                "these logs do not determine values next to that bound"));
  return model;
}

/// Adds an issue for each joint whose logged torque is too large or too small.
void add_gain_issues(const std::vector<double>& gain, Issues& issues) {
  for (std::size_t j = 0; j < gain.size(); ++j) {
    if (gain[j] == 1.0) continue;
    const Joint joint = Joint::at(static_cast<int>(j));
    issues.add(make_issue(
        fmt::format("torque_gain_{}", joint), Severity::warning,
        fmt::format("the torque of joint {} is {:.3f} times the value in its column, according to the "
                    "masses that it shares with the joints before: check its unit, torque constant and "
                    "gear ratio. The identified robot applies this factor (torque_gain)",
                    joint, gain[j])));
  }
}

/// Returns the robot with what is not in the equations of motion: the torque gains of the log, its motor
/// constants and the compliance of gears.
Robot with_drives(Robot robot, const Gathered& gathered, const TorqueFit& torque) {
  const ParameterSpace& space = torque.space;
  const int n = space.joints();
  const auto scale = [&](const std::vector<double>& gain) {
    robot.torque_gain.resize(n, 1.0);
    for (int j = 0; j < n; ++j) robot.torque_gain[j] *= gain[j];
    for (std::size_t j = 0; j < robot.torque_limit.size(); ++j) robot.torque_limit[j] *= std::abs(gain[j]);
  };
  if (!gathered.torque_gain.empty()) scale(gathered.torque_gain);
  if (gathered.constants) scale(gathered.constants->constant);
  robot.gear_compliance.clear();
  for (int p = space.extra_begin(); p < space.timing(); ++p) {
    const ExtraTerm& term = space.extra_at(p);
    if (term.kind != ExtraKind::gear_compliance) continue;
    robot.gear_compliance.resize(n, 0.0);
    robot.gear_compliance[term.joint.index()] = torque.fit.parameters[p];
  }
  return robot;
}

}  // namespace

AlikeFit fit_alike(std::span<LogSource* const> logs, const Robot& robot, const IdentifyOptions& options,
                   const Progress& progress) {
  AlikeFit fit;
  Identification& id = fit.id;
  id.robot = robot;
  id.space = parameter_space(robot);
  Gathered read = gather(logs, id.space, kShortestWindow_s, kMostWindows, progress);
  if (robot.log.torque == TorqueMeaning::current) read = with_motor_constants(logs, std::move(read));
  id.logs = std::move(read.logs);
  id.issues = read.issues;
  for (const LogSurvey& survey : read.surveys) id.issues.merge(survey_issues(survey, robot.torque_limit));
  DraftedModel model = draft_model(logs, std::move(read), options, id, id.issues);
  const Gathered& gathered = model.gathered;
  const std::vector<Joint>& still = gathered.windows.still;
  const ModelDraft& draft = model.draft;
  TorqueFit& torque = model.draft.torque;
  id.space = torque.space;
  for (std::size_t i = 0; i < id.logs.size(); ++i) id.logs[i].left_out = gathered.left_out[i];
  id = with_settled_method(logs, model, options, progress, std::move(id));
  id.robot = with_drives(std::move(id.robot), gathered, torque);
  add_gain_issues(gathered.torque_gain, id.issues);
  if (gathered.constants) id.issues.add(motor_constants_issue(*gathered.constants));

  const std::vector<Joint> undriven = undriven_joints(torque);
  const Confounded confounded = confounded_parameters(robot, still, undriven, torque);
  torque.fit.confounded = confounded.parameters;
  id.condition_number = torque.fit.condition_number;
  id.held_out_r2 = draft.choice.held_out_r2;
  id.terms = draft.choice.terms;
  id = with_verdict(torque, draft.choice, gathered, undriven, std::move(id));
  const bool is_infeasible = !torque.why_infeasible.empty();
  id = with_judged_columns(logs, gathered, is_infeasible, std::move(id));
  if (id.method == IdentifyMethod::weak_form) id = with_smooth_friction(draft.nominal, std::move(id));
  const TableFacts facts{torque.wanted, still, undriven, confounded.leaning};
  id.base_parameters = base_parameter_table(torque.fit, facts, id);
  using Status = IdentificationStatus;
  if (is_infeasible && id.status == Status::converged)
    id.take(
        FitStatus{Status::poorly_excited, "the best fit is infeasible: no real robot has these parameters"});
  if (!all_identifiable(id) && id.status == Status::converged)
    id.take(FitStatus{Status::poorly_excited, why_not_identifiable(facts)});
  for (int p = 0; p < id.space.rigid(); ++p)
    fit.usable.push_back(torque.fit.free[p] && !torque.fit.confounded[p]);
  return fit;
}

}  // namespace faultline
