// SPDX-License-Identifier: MIT
#include "lib/identify/fit_alike.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/identify/feasible.hpp"
#include "lib/identify/gathered.hpp"
#include "lib/identify/parameter_table.hpp"
#include "lib/identify/shooting_stage.hpp"
#include "lib/identify/verdict/fit_verdict.hpp"
#include "lib/identify/verdict/log_agreement.hpp"
#include "lib/identify/verdict/misreading.hpp"
#include "lib/identify/wanted_parameters.hpp"
#include "lib/identify/weak_form/weak_choice.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr double kGood = 0.97;            // of a joint's torque explained: below, columns are questioned
constexpr double kWorthShooting = 0.95;   // of every joint's torque: below, the motion has nothing to add
constexpr double kSmallRotor = 0.02;      // of the inertia its joint moves
constexpr double kClearlyThere = 4.0;     // standard deviations above zero that a rotor must have
constexpr double kClearlyNegative = 4.0;  // standard deviations below zero that are no doubt any more

double nominal_timing(const Robot& robot) {
  if (robot.log.torque_between_samples == TorqueTiming::held) return 0.0;
  return robot.torque_phi.value_or(0.5);
}

Issue note(const char* code, Severity severity, std::string message) {
  Issue issue;
  issue.code = code;
  issue.severity = severity;
  issue.message = std::move(message);
  return issue;
}

std::vector<double> list(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

void take_noise(const Eigen::VectorXd& noise, bool has_dq, Identification& id) {
  id.q_noise = list(noise.head(id.space.joints()));
  if (has_dq) id.dq_noise = list(noise.tail(id.space.joints()));
}

/// Whether no robot has this parameter below zero.
bool is_not_negative(const ParameterSpace& space, int p) {
  return p < space.rigid() ? space.base[p].is_rotor : p < space.offset(0);
}

/// An inertia that next to that of its joint nobody would miss.
double small_rotor(const ParameterSpace& space, const TorqueFit& torque, int p) {
  const Chain<double> chain = chain_from(space, torque.fit.parameters);
  const int joint = space.base[p].name.back() - '1';
  return kSmallRotor *
         std::abs(inertia_matrix(chain, JointVector<double>::Zero(space.joints()).eval())(joint, joint));
}

/// Friction and rotors that come out a little below zero are none, and so are rotors that are not told from
/// zero: they are held there and the rest is fitted again.
void hold_at_zero(const ParameterSpace& space, Eigen::VectorXd start, TorqueFit& torque) {
  std::vector<bool> moving = torque.wanted;
  std::vector<std::pair<int, double>> held;
  for (bool more = true; more;) {
    more = false;
    for (int p = 0; p < space.offset(0); ++p) {
      if (!moving[p] || !is_not_negative(space, p)) continue;
      const double std = std::sqrt(torque.fit.covariance(p, p)), value = torque.fit.parameters[p];
      const double least = p < space.rigid() ? kClearlyThere * std : 0.0;
      const double doubt =
          std::max(kClearlyNegative * std, p < space.rigid() ? small_rotor(space, torque, p) : 0.0);
      if (value >= least || value < -doubt) continue;
      moving[p] = false;
      start[p] = 0.0;
      held.emplace_back(p, std * std);
      more = true;
    }
    if (more) torque.fit = fit_weak_form(torque.system, space, start, moving);
  }
  for (const auto& [p, variance] : held) {
    if (p < space.rigid()) {
      torque.wanted[p] = false;
      continue;
    }
    torque.fit.covariance(p, p) = variance;
    torque.fit.free[p] = true;
    torque.fit.confounded[p] = false;
  }
}

/// The fit of the torque balance, brought to a robot that can be.
TorqueFit fit_torque(const Gathered& gathered, const ModelChoice& choice, const Eigen::VectorXd& nominal,
                     Identification& id) {
  TorqueFit out{assemble(gathered.windows, choice.weak), {}, choice.wanted, choice.weak.shift};
  out.fit = fit_weak_form(out.system, id.space, nominal, out.wanted);
  hold_at_zero(id.space, nominal, out);
  const Measurements& m = gathered.measurements;
  const std::string wrong =
      infeasibility(id.space, out.fit.parameters, out.fit.covariance, m.q_low(), m.q_high());
  if (wrong.empty()) return out;
  out.fit.parameters.head(id.space.linear()) =
      nearest_feasible(id.space, id.robot, out.system, out.fit, out.wanted).head(id.space.linear());
  out.fit.residual = out.system.y - out.system.a * out.fit.parameters.head(id.space.linear());
  id.issues.add(note("infeasible", Severity::warning,
                     wrong + "; the nearest robot that can be was taken instead: values next to that bound "
                             "are not told by these logs"));
  return out;
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

/// Sharp friction serves the regression; a robot that is to be simulated keeps the width of its file.
void smooth_friction(const Eigen::VectorXd& nominal, const ParameterSpace& space,
                     Eigen::VectorXd& parameters) {
  for (int j = 0; j < space.joints(); ++j) {
    double& width = parameters[space.log_width(j)];
    width = std::max(width, nominal[space.log_width(j)]);
  }
}

/// A mass or inertia that only joints at rest show is confounded with their stiction.
void doubt_still_joints(const TorqueFit& torque, const ParameterSpace& space, const std::vector<int>& still,
                        std::vector<bool>& confounded) {
  constexpr double kShown = 1e-6;  // share of the squared column that moving joints must carry
  for (int p = 0; p < space.rigid(); ++p) {
    double all = 0.0, shown = 0.0;
    for (Eigen::Index k = 0; k < torque.system.a.rows(); ++k) {
      const double square = torque.system.a(k, p) * torque.system.a(k, p);
      all += square;
      if (std::count(still.begin(), still.end(), torque.system.joint[k] + 1) == 0) shown += square;
    }
    if (shown <= kShown * all) confounded[p] = true;
  }
}

void name_odd_logs(const std::vector<int>& odd, bool kept, Identification& id) {
  for (const int log : odd) {
    id.logs[log].left_out = !kept;
    id.issues.add(
        note(fmt::format("odd_log_{}", log + 1).c_str(), Severity::warning,
             fmt::format("{} disagrees with the other logs: a fit to them leaves far more of its "
                         "torque unexplained than of theirs; {}",
                         id.logs[log].path,
                         kept ? "it was kept as asked"
                              : "it was left out (--keep-all keeps it). Is it another robot, another "
                                "load, or a fault?")));
  }
}

/// Looks for another meaning of the columns when the robot cannot be what the logs say.
void question_columns(std::span<LogSource* const> logs, const std::vector<int>& still, bool infeasible,
                      Identification& id) {
  bool poor = false;
  for (std::size_t j = 0; j < id.fit_r2.size(); ++j)
    if (std::count(still.begin(), still.end(), static_cast<int>(j) + 1) == 0)
      poor = poor || !(id.fit_r2[j] > kGood);
  for (int j = 0; j < id.space.joints(); ++j)
    if (const Issue* issue = id.issues.find(fmt::format("velocity_disagrees_{}", j + 1))) {
      id.status = IdentificationStatus::unexplained;
      id.reason += "; " + issue->message;
    }
  if (!poor && !infeasible) return;
  const Misreading found = find_misreading(logs, id.robot);
  if (found.what.empty()) return;
  id.status = IdentificationStatus::unexplained;
  id.reason += fmt::format("; it looks as if {}", found.what);
  id.issues.add(
      note("misread_columns", Severity::severe,
           fmt::format("it looks as if {}: then the robot explains at least {:.1f} % of every joint's "
                       "torque, as the logs are read now {}; write {} into [log.columns]",
                       found.what, 100.0 * found.r2_after,
                       found.r2_before > 0.0 ? fmt::format("{:.1f} %", 100.0 * found.r2_before)
                                             : std::string("it does not"),
                       found.cure)));
}

/// The motion's fit where it helps, else the torque balance's.
void settle_method(std::span<LogSource* const> logs, const Gathered& gathered, TorqueFit& torque,
                   const std::vector<int>& still, const Eigen::VectorXd& nominal,
                   const IdentifyOptions& options, const Progress& progress, Identification& id) {
  const double worst = *std::min_element(torque.fit.r2.begin(), torque.fit.r2.end());
  if (options.method == IdentifyMethod::automatic && worst < kWorthShooting && still.empty()) {
    id.issues.add(
        note("torque_unexplained", Severity::note,
             fmt::format("the model explains only {:.1f} % of some joint's torque: its motion was not "
                         "fitted",
                         100.0 * std::max(worst, 0.0))));
  } else if (options.method != IdentifyMethod::weak_form) {
    TorqueFit start = torque;
    for (int j = 0; j < id.space.joints(); ++j)
      start.fit.parameters[id.space.log_width(j)] = nominal[id.space.log_width(j)];
    const ShootingOutcome shot = shoot(logs, gathered, start, id, options, progress);
    const bool forced = options.method == IdentifyMethod::output_error && shot.fit.parameters.size() > 0;
    if (shot.refused.empty() || forced) {
      take_shooting(shot.fit, gathered, id);
      return;
    }
    id.issues.add(note("model_error", Severity::note,
                       shot.refused + "; values and intervals come from the momentum balance over short "
                                      "windows instead of the output error"));
  }
  take_torque_fit(torque, gathered, id);
}

}  // namespace

AlikeFit fit_alike(std::span<LogSource* const> logs, const Robot& robot, const IdentifyOptions& options,
                   const Progress& progress) {
  AlikeFit fit;
  Identification& id = fit.id;
  id.robot = robot;
  id.space = parameter_space(robot);
  Gathered gathered = gather(logs, options.window_s, options.max_windows, progress, id);
  const std::vector<int> still = still_joints(gathered.measurements, id.space.joints());
  const Eigen::VectorXd nominal = parameters_of(id.space, robot.chain, nominal_timing(robot));
  const WantedParameters wanted =
      wanted_parameters(id.space, robot, still, options.estimate_offset && has_fast_log(id));
  const auto choose = [&] {
    return choose_model(WeakMoments(gathered.windows, nominal_timing(robot)), id.space, nominal, wanted.asked,
                        wanted.optional, gathered.windows.shifts,
                        static_cast<int>(gathered.windows.sets.size()));
  };
  ModelChoice choice = choose();
  if (const std::vector<int> odd = odd_logs(choice); !odd.empty()) {
    name_odd_logs(odd, options.keep_all, id);
    if (!options.keep_all) {
      gathered.leave_out(odd);
      choice = choose();
    }
  }
  TorqueFit torque = fit_torque(gathered, choice, nominal, id);
  settle_method(logs, gathered, torque, still, nominal, options, progress, id);

  doubt_still_joints(torque, id.space, still, torque.fit.confounded);
  id.condition_number = torque.fit.condition_number;
  judge_fit(torque, choice, gathered, still, id);
  tell_spread(choice, id);
  question_columns(logs, still, id.issues.find("infeasible") != nullptr, id);
  if (id.method == IdentifyMethod::weak_form) smooth_friction(nominal, id.space, id.estimate);
  list_base_parameters(torque.fit, {torque.wanted, still, has_fast_log(id)}, id);
  if (!all_told(id) && id.status == IdentificationStatus::converged) {
    id.status = IdentificationStatus::poorly_excited;
    id.reason += "; " + not_excited(still);
  }
  for (int p = 0; p < id.space.rigid(); ++p)
    fit.usable.push_back(torque.fit.free[p] && !torque.fit.confounded[p]);
  return fit;
}

}  // namespace faultline
