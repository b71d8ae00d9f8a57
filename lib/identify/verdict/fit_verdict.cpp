// SPDX-License-Identifier: MIT
#include "lib/identify/verdict/fit_verdict.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/identify/excitation/excitation.hpp"
#include "lib/identify/verdict/parameter_trend.hpp"

namespace faultline {
namespace {

constexpr double kWellExplained = 0.95;  // of a joint's torque: less is explained in part only
constexpr double kLightOfRotor =
    0.01;  // of the rotor's inertia: a smaller mass is one on which no gravity acts
constexpr double kLightest = 1e-3, kHeaviest = 300.0;  // kg: bounds of a plausible mass on a prismatic joint

/// Sums over the rows of one joint (and log) that count.
struct RowSums {
  double rows = 0.0, left = 0.0, torque = 0.0, square = 0.0;

  void add(double y, double residual) {
    rows += 1.0;
    left += residual * residual;
    torque += y;
    square += y * y;
  }
  double rms() const { return std::sqrt(left / std::max(rows, 1.0)); }
  double r2() const {
    const double spread = square - torque * torque / std::max(rows, 1.0);
    return spread > 0.0 ? 1.0 - left / spread : std::numeric_limits<double>::quiet_NaN();
  }
};

/// Stores the torque delays: whole samples in the robot, and, with the timing between samples, relative to a
/// straight line between them, in the result.
void store_delays(const ModelChoice& choice, const Gathered& gathered, Identification& id) {
  double period = 0.0;
  for (const LogSurvey& survey : gathered.surveys) period = std::max(period, survey.summary.period_s);
  std::vector<double> whole = id.robot.torque_delay_s;
  whole.resize(choice.weak.shift.size(), 0.0);
  for (std::size_t j = 0; j < whole.size(); ++j) {
    whole[j] += choice.weak.shift[j] * period;
    id.torque_delay_s.push_back(whole[j] + (0.5 - id.estimate[id.space.timing()]) * period);
  }
  const bool none = std::all_of(whole.begin(), whole.end(), [](double s) { return s == 0.0; });
  id.robot.torque_delay_s = none ? std::vector<double>{} : whole;
}

void keep_curves(const TorqueFit& torque, const ModelChoice& choice, const Gathered& gathered,
                 const Eigen::VectorXd& residual, Identification& id) {
  id.joint_fits.assign(torque.system.joints, {});
  Eigen::Index row = 0;
  for (int j = 0; j < torque.system.joints; ++j) {
    JointFit& fit = id.joint_fits[j];
    const WeakWindows& set = gathered.windows.sets[choice.weak.set[j]];
    fit.window_s = set.length_s();
    for (const WeakWindow& w : set.all()) {
      fit.log.push_back(w.log);
      fit.time_s.push_back(w.time_s);
      fit.q.push_back(w.q[j]);
      fit.dq.push_back(w.dq[j]);
      fit.measured.push_back(torque.system.y[row]);
      fit.modelled.push_back(torque.system.y[row] - residual[row]);
      const auto friction = [&](int p) { return torque.system.a(row, p) * id.estimate[p]; };
      fit.friction.push_back(friction(id.space.viscous(j)) + friction(id.space.coulomb(j)) +
                             friction(id.space.offset(j)));
      fit.moving.push_back(torque.system.use[row] > 0.0);
      ++row;
    }
    id.residual_patterns.push_back(residual_pattern(fit));
  }
}

/// Returns the rotor inertia of the joint that a mass is named after, kg; 0 if it has none.
double rotor_beside(const Identification& id, int mass) {
  const std::string rotor = "jr" + id.space.name(mass).substr(1);
  for (int p = 0; p < id.space.rigid(); ++p)
    if (id.space.base[p].is_rotor && id.space.name(p) == rotor) return id.estimate[p];
  return 0.0;
}

/// Sets the status to `unexplained` if a mass is implausible and the robot file gives no mass.
void find_implausible(Identification& id) {
  for (int j = 0; j < id.space.joints(); ++j)
    if (id.robot.known.contains(fmt::format("m{}", j + 1))) return;
  for (int p = 0; p < id.space.rigid(); ++p) {
    const double mass = id.estimate[p];
    if (!id.space.base[p].is_mass || !(id.covariance(p, p) > 0.0)) continue;
    if (std::abs(mass) < kLightOfRotor * rotor_beside(id, p)) {
      id.status = IdentificationStatus::unexplained;
      id.reason += fmt::format(
          "; {0} shows no weight, it was estimated as {1:.4g} kg: if its axis is horizontal or the order of "
          "axes differs, correct gravity or axes in the robot file, or state {0} under [known]",
          id.space.name(p), mass);
      continue;
    }
    if (mass > kLightest && mass < kHeaviest) continue;
    id.status = IdentificationStatus::unexplained;
    id.reason += fmt::format(
        "; {0} was estimated as {1:.4g} kg: if that is not its mass, the torque is in another unit; if it "
        "is, state it as {0} under [known]",
        id.space.name(p), mass);
  }
}

void find_unexplained(const std::vector<int>& still, Identification& id) {
  std::vector<int> joints;
  for (std::size_t j = 0; j < id.fit_r2.size(); ++j)
    if (!(id.fit_r2[j] >= kExplained) && std::count(still.begin(), still.end(), static_cast<int>(j) + 1) == 0)
      joints.push_back(static_cast<int>(j) + 1);
  if (joints.empty()) return;
  id.status = IdentificationStatus::unexplained;
  id.reason += fmt::format("; the torque of joint {} is not the torque that this robot needs for its motion",
                           fmt::join(joints, ", "));
}

/// Finds moving, driven joints whose torque is explained in part only, or not in held-out windows.
void find_poorly_explained(const std::vector<int>& exempt, Identification& id) {
  if (id.status != IdentificationStatus::converged) return;
  for (std::size_t j = 0; j < id.fit_r2.size(); ++j) {
    if (std::count(exempt.begin(), exempt.end(), static_cast<int>(j) + 1) > 0) continue;
    const double held_out = id.held_out_r2[j];
    if (id.fit_r2[j] >= kWellExplained && held_out >= kWellExplained) continue;
    id.status = IdentificationStatus::poorly_explained;
    id.reason += fmt::format(
        "; joint {}: the model explains {:.0f} % of the torque it was fitted to and {:.0f} % of the held-out "
        "torque, so values are rough: {}",
        j + 1, 100.0 * std::max(id.fit_r2[j], 0.0), 100.0 * std::max(held_out, 0.0),
        id.fit_r2[j] >= kWellExplained ? "the logs are too short for this many parameters; give longer ones"
                                       : "check the load, the gravity and the order of axes, and whether a "
                                         "joint has friction of a kind that the model lacks");
    return;
  }
}

}  // namespace

void judge_fit(const TorqueFit& torque, const ModelChoice& choice, const Gathered& gathered,
               const std::vector<int>& still, const std::vector<int>& undriven, Identification& id) {
  const WeakSystem& s = torque.system;
  const Eigen::VectorXd residual = s.y - s.a * id.estimate.head(id.space.linear());
  std::vector<RowSums> joints(s.joints);
  std::vector<std::vector<RowSums>> by_log(id.logs.size(), std::vector<RowSums>(s.joints));
  for (Eigen::Index k = 0; k < s.y.size(); ++k) {
    if (s.use[k] == 0.0) continue;
    joints[s.joint[k]].add(s.y[k], residual[k]);
    by_log[s.log[k]][s.joint[k]].add(s.y[k], residual[k]);
  }
  for (const RowSums& sums : joints) {
    id.residual_rms.push_back(sums.rms());
    id.fit_r2.push_back(sums.r2());
  }
  for (std::size_t i = 0; i < by_log.size(); ++i)
    for (const RowSums& sums : by_log[i]) id.logs[i].fit_r2.push_back(sums.r2());
  id.held_out_r2 = choice.held_out_r2;
  id.terms = choice.terms;
  store_delays(choice, gathered, id);
  keep_curves(torque, choice, gathered, residual, id);
  id.excitation = motion_excitation(torque, id.space, id.joint_fits, id.residual_rms, still);
  id.trends = parameter_trends(torque, id.space, id.joint_fits);
  find_unexplained(still, id);
  find_implausible(id);
  std::vector<int> exempt = still;
  exempt.insert(exempt.end(), undriven.begin(), undriven.end());
  find_poorly_explained(exempt, id);
}

}  // namespace faultline
