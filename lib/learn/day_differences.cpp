// SPDX-License-Identifier: MIT
#include "lib/learn/day_differences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/error.hpp"
#include "lib/identify/days/healthy_day.hpp"
#include "lib/identify/feasible/feasible.hpp"

namespace faultline {
namespace {

constexpr double kLeastMemory_s = 0.002, kLongestMemory_s = 2.0;  // correlation time of a missed torque

/// Sets the missed torque of a joint and its correlation time from the noise of its rows.
void take_missed_torque(const BalanceModel& m, int j, DayDifferences& out) {
  const Eigen::VectorXd covariance = autocovariance(m.noise.joint[j]);
  const double variance = m.noise.joint[j].base * covariance[0];
  if (!(variance > 0.0)) return;
  const double again = covariance.size() > 1 ? covariance[1] / covariance[0] : 0.0;
  const double memory_s = again > 0.0 ? -m.setting.row_s() / elementary::log(again) : kLeastMemory_s;
  out.missed[j] = std::sqrt(variance);
  out.missed_memory_s[j] = std::clamp(memory_s, kLeastMemory_s, kLongestMemory_s);
}

DayLayout day_layout_of(const BalanceModel& m) { return day_layout(m); }
StepDayLayout day_layout_of(const OneStepModel& m) { return m.day_layout(); }

int offset_at(const DayLayout& at, int j) { return at.offset(j); }
int offset_at(const StepDayLayout& at, int j) { return at.force(j); }

/// Returns an extra friction of the model, not negative; `estimate` if it is none. One-step models have no
/// friction by load.
double extra_friction(const BalanceModel& m, const ExtraTerm& term, double estimate) {
  const std::optional<int> column = column_of(term, m.layout());
  if (!column || term.kind == ExtraKind::shared_inertia) return estimate;
  return std::max(m.theta[*column], 0.0);
}
double extra_friction(const OneStepModel&, const ExtraTerm& term, double estimate) {
  return term.kind == ExtraKind::load_friction ? 0.0 : estimate;
}

/// Raises a variance to that of a range that the robot file states, scaled; `usual` is the default, which
/// changes nothing.
void widen(double range, double usual, double scale, double& variance) {
  if (range == usual) return;
  variance = std::max(variance, Eigen::numext::abs2(range * scale / DayEffect::kStdsInRange));
}

double top_speed_of(const BalanceModel& m, int j) { return m.top_speed[j]; }
double top_speed_of(const OneStepModel&, int) { return 0.0; }

/// Returns the identification with the friction of the model that explains the logs.
template <typename Rows>
Identification with_friction_of(Identification identification, const Rows& model,
                                const Eigen::VectorXd& width) {
  const ParameterSpace& space = identification.space;
  const auto layout = model.layout();
  for (int j = 0; j < space.joints(); ++j) {
    const double viscous = model.theta[layout.viscous(j)], coulomb = model.theta[layout.coulomb(j)];
    // Friction that falls with speed is that of half the top speed: a simulated joint has no negative one.
    identification.estimate[space.viscous(j)] = std::max(viscous, 0.0);
    identification.estimate[space.coulomb(j)] =
        std::max(coulomb + 0.5 * std::min(viscous, 0.0) * top_speed_of(model, j), 0.0);
    identification.estimate[space.log_width(j)] = elementary::log(width[j]);
    identification.robot.chain.friction[j].width = width[j];
  }
  for (int k = space.extra_begin(); k < space.timing(); ++k)
    identification.estimate[k] = extra_friction(model, space.extra_at(k), identification.estimate[k]);
  return identification;
}

// Columns and effects of the day of a base parameter of the space; a one-step model has no rotors.
bool has_base(const BalanceModel&, const BaseParameter&) { return true; }
bool has_base(const OneStepModel&, const BaseParameter& parameter) { return !parameter.is_rotor; }
int inertia_at(const DayLayout&, int base) { return base; }
int inertia_at(const StepDayLayout& at, int base) { return at.inertia(base); }

/// Returns the identification with the base parameters of the model that explains the logs, and their
/// variance between days, if they are feasible; else unchanged.
template <typename Rows>
Identification with_base_of(const Identification& identification, const Rows& model) {
  Identification out = identification;
  const ParameterSpace& space = out.space;
  out.covariance.setZero();
  for (int p = 0, at = 0; p < space.rigid(); ++p) {
    out.estimate[p] = 0.0;
    if (!has_base(model, space.base[p])) continue;
    const bool is_positive = space.base[p].is_mass || space.base[p].is_rotor;
    out.estimate[p] = is_positive ? std::max(model.theta[at], 0.0) : model.theta[at];
    out.covariance(p, p) =
        model.day_variance[inertia_at(day_layout_of(model), at)] * Eigen::numext::abs2(model.theta[at]);
    ++at;
  }
  const bool is_feasible =
      infeasibility(space, out.estimate, out.covariance, model.q_low, model.q_high).empty();
  return is_feasible ? out : identification;
}

/// Returns the identification with the measurement noise that one-step predictions estimate: with few samples
/// per move there is no other estimate.
Identification with_noise_of(Identification identification, const OneStepModel& model) {
  const Eigen::VectorXd noise = model.reading_variance.cwiseSqrt();
  identification.q_noise.assign(noise.begin(), noise.begin() + model.joints());
  if (!identification.dq_noise.empty())
    identification.dq_noise.assign(noise.begin() + model.joints(), noise.end());
  return identification;
}

Error predictions_diverge(double period_s) {
  return {
      ErrorCode::input, "the healthy logs",
      fmt::format("no robot predicts their motion over one sample period of {:.3g} s. State how the torque "
                  "acts between samples ([log] torque_between_samples), or give logs with slower moves or a "
                  "shorter sample period",
                  period_s)};
}

}  // namespace

DayDifferences day_differences(const RobotRows& robot) {
  const auto differences = [](const auto& m) {
    const auto at = day_layout_of(m);
    DayDifferences out = DayDifferences::none(m.joints());
    for (int j = 0; j < m.joints(); ++j) {
      out.offset[j] = std::sqrt(m.day_variance[offset_at(at, j)]);
      out.friction[j] = std::sqrt(m.day_variance[at.friction(j)]);
      out.viscous_excess[j] = std::sqrt(m.day_variance[at.viscous_excess(j)]);
      out.gain[j] = std::sqrt(m.day_variance[at.gain(j)]);
    }
    return out;
  };
  DayDifferences out = std::visit(differences, robot);
  if (const auto* rows = std::get_if<BalanceModel>(&robot))
    for (int j = 0; j < rows->joints(); ++j) take_missed_torque(*rows, j, out);
  return out;
}

RobotRows with_stated_ranges(RobotRows robot, const NormalRange& stated,
                             const std::vector<double>& torque_scale) {
  const NormalRange usual;
  const auto widen_days = [&](auto& m) {
    const auto at = day_layout_of(m);
    for (int j = 0; j < m.joints(); ++j) {
      widen(stated.friction, usual.friction, 1.0, m.day_variance[at.friction(j)]);
      widen(stated.friction, usual.friction, 1.0, m.day_variance[at.viscous_excess(j)]);
      widen(stated.torque_offset, usual.torque_offset, torque_scale[j], m.day_variance[offset_at(at, j)]);
      widen(stated.torque_constant, usual.torque_constant, 1.0, m.day_variance[at.gain(j)]);
    }
  };
  std::visit(widen_days, robot);
  if (auto* rows = std::get_if<BalanceModel>(&robot)) {
    if (stated.work_piece_kg > 0.0) rows->piece_kg = stated.work_piece_kg;
    for (int j = 0; j < rows->joints(); ++j)
      widen(stated.friction, usual.friction, 1.0, rows->day_variance[day_layout_of(*rows).friction_slope(j)]);
  }
  return robot;
}

Identification with_explained_robot(const Identification& identification, const RobotRows& robot) {
  if (const auto* rows = std::get_if<BalanceModel>(&robot))
    return with_base_of(with_friction_of(identification, *rows, rows->setting.friction_width), *rows);
  const auto& steps = std::get<OneStepModel>(robot);
  if (!steps.theta.allFinite() || !steps.reading_variance.allFinite())
    throw predictions_diverge(steps.setting.period_s);
  return with_noise_of(
      with_base_of(with_friction_of(identification, steps, steps.body.friction_width()), steps), steps);
}

}  // namespace faultline
