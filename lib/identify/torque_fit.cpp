// SPDX-License-Identifier: MIT
#include "lib/identify/torque_fit.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lib/identify/feasible/feasible.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr double kSmallRotor = 0.02;   // of the inertia that its joint moves: a smaller rotor is negligible
constexpr double kClearlyThere = 4.0;  // standard deviations above zero that rotors and extra terms need
constexpr double kClearlyNegative = 4.0;  // standard deviations below zero that are clearly negative
constexpr int kTimingRounds = 3;  // rounds, at most, that move whole samples from the timing to the delay
constexpr double kTimingSlack = 0.05;  // samples by which noise may move the timing out of its range

/// Returns the space with the width that was chosen for the bent friction of every joint.
ParameterSpace with_bend_widths(ParameterSpace space, const WeakChoice& choice) {
  for (int j = 0; j < space.joints(); ++j)
    space.chain.friction[j].bend_width = weak_width(space, j, choice.bend[j]);
  return space;
}

/// Whether the parameter cannot be below zero.
bool is_not_negative(const ParameterSpace& space, int p) {
  return p < space.rigid() ? space.base[p].is_rotor : p < space.offset(0);
}

/// Returns an inertia that is negligible beside that of its joint.
double small_rotor(const TorqueFit& torque, int p) {
  const Chain chain = chain_from(torque.space, torque.fit.parameters);
  const int j = torque.space.base[p].joint.index();
  return kSmallRotor * std::abs(inertia_matrix(chain, JointVector::Zero(chain.joints()).eval())(j, j));
}

/// Returns the fit of the wanted parameters; the others stay at `nominal`.
TorqueFit refitted(const Eigen::VectorXd& nominal, TorqueFit torque) {
  torque.fit = fit_weak_form(torque.system, torque.space, nominal, torque.wanted);
  return torque;
}

/// Holds at zero friction and rotors that are slightly negative, and rotors that do not differ clearly from
/// zero, and fits the other parameters again.
TorqueFit hold_at_zero(Eigen::VectorXd nominal, TorqueFit torque) {
  const ParameterSpace& space = torque.space;
  std::vector<bool> moving = torque.wanted;
  std::vector<std::pair<int, double>> held;
  for (bool more = true; more;) {
    more = false;
    for (int p = 0; p < space.offset(0); ++p) {
      if (!moving[p] || !is_not_negative(space, p)) continue;
      const double std = std::sqrt(torque.fit.covariance(p, p)), value = torque.fit.parameters[p];
      const double least = p < space.rigid() ? kClearlyThere * std : 0.0;
      const double doubt = std::max(kClearlyNegative * std, p < space.rigid() ? small_rotor(torque, p) : 0.0);
      if (value >= least || value < -doubt) continue;
      moving[p] = false;
      nominal[p] = 0.0;
      held.emplace_back(p, std * std);
      more = true;
    }
    if (more) torque.fit = fit_weak_form(torque.system, space, nominal, moving);
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
  return torque;
}

/// Removes extra terms that are impossible or do not differ clearly from zero, the least certain first. A
/// ripple's cosine may well be zero.
TorqueFit drop_insignificant_extra(const Eigen::VectorXd& nominal, TorqueFit torque) {
  const ParameterSpace& space = torque.space;
  for (;;) {
    int worst = -1;
    double least = kClearlyThere;
    for (int p = space.extra_begin(); p < space.timing(); ++p) {
      const double value = torque.fit.parameters[p], std = std::sqrt(torque.fit.covariance(p, p));
      if (!torque.wanted[p] || is_ripple(space.extra_at(p).kind)) continue;
      const double significance = std > 0.0 && is_possible(space.extra_at(p).kind, value) ? value / std : 0.0;
      if (significance < least) least = significance, worst = p;
    }
    if (worst < 0) return torque;
    torque.wanted[worst] = false;
    torque = refitted(nominal, std::move(torque));
  }
}

/// Removes friction that would drive its joint: bends beyond the Coulomb friction and skews beyond the
/// viscous friction.
TorqueFit drop_driving_friction(const Eigen::VectorXd& nominal, TorqueFit torque) {
  const ParameterSpace& space = torque.space;
  for (int j = 0; j < space.joints(); ++j) {
    const Eigen::VectorXd& p = torque.fit.parameters;
    const bool bend = p[space.bend(j)] < -p[space.coulomb(j)];
    const bool skew = std::abs(p[space.skew(j)]) > p[space.viscous(j)];
    if (!(bend && torque.wanted[space.bend(j)]) && !(skew && torque.wanted[space.skew(j)])) continue;
    if (bend) torque.wanted[space.bend(j)] = false;
    if (skew) torque.wanted[space.skew(j)] = false;
    torque = refitted(nominal, std::move(torque));
  }
  return torque;
}

std::string what_is_wrong(const TorqueFit& torque, const Measurements& m) {
  return infeasibility(torque.space, torque.fit.parameters, torque.fit.covariance, m.q_low(), m.q_high());
}

/// Returns the same fit with every rotor that the robot may have: without them, links can get negative mass.
TorqueFit with_rotors(const Robot& robot, const Eigen::VectorXd& nominal, TorqueFit torque) {
  const ParameterSpace& space = torque.space;
  for (int p = 0; p < space.rigid(); ++p)
    if (space.base[p].is_rotor && robot.known.count(space.base[p].name) == 0) torque.wanted[p] = true;
  return hold_at_zero(nominal, refitted(nominal, std::move(torque)));
}

/// Returns the covariance of the fit with that of unknown friction widths added for the free parameters.
Eigen::MatrixXd with_doubt(const Eigen::MatrixXd& doubt, Eigen::MatrixXd covariance) {
  for (Eigen::Index i = 0; i < doubt.rows(); ++i)
    for (Eigen::Index k = 0; k < doubt.cols(); ++k)
      if (covariance(i, i) > 0.0 && covariance(k, k) > 0.0) covariance(i, k) += doubt(i, k);
  return covariance;
}

/// Returns the fit of the balances of another choice.
TorqueFit fit_again(const WeakSets& windows, const Eigen::VectorXd& nominal, const WeakChoice& choice,
                    TorqueFit torque) {
  torque.system = assemble(windows, choice);
  torque.shift = choice.shift;
  return refitted(nominal, std::move(torque));
}

/// Limits the timing to 0 ... 1: beyond, it becomes whole samples of delay of all joints. A torque held over
/// its sample fits as well with a sample of delay and timing 1; the form without the delay is used.
TorqueFit settle_timing(const WeakSets& windows, const Eigen::VectorXd& nominal, WeakChoice choice,
                        TorqueFit torque) {
  const int timing = torque.space.timing();
  const auto phi = [&] { return torque.fit.parameters[timing]; };
  const auto delay_all = [&](int later) {  // within the windows
    const std::vector<int> before = choice.shift;
    for (int& shift : choice.shift)
      shift = std::clamp(shift + later, windows.shifts.first + 1, windows.shifts.last);
    if (choice.shift == before) return false;
    torque = fit_again(windows, nominal, choice, std::move(torque));
    return true;
  };
  for (int round = 0; round < kTimingRounds && torque.fit.free[timing]; ++round) {
    const bool inside = phi() > -kTimingSlack && phi() < 1.0 + kTimingSlack;
    if (inside || !delay_all(-static_cast<int>(std::floor(phi())))) break;
  }
  const bool delayed = *std::min_element(choice.shift.begin(), choice.shift.end()) > 0;
  if (torque.fit.free[timing] && phi() > 1.0 - kTimingSlack && delayed) delay_all(-1);
  return torque;
}

/// Removes delays of single joints, which were chosen before the torque's timing was fitted: half a sample
/// resembles one. A joint keeps its own only if no delay of another joint explains its torque as well.
TorqueFit drop_own_delays(const WeakSets& windows, const Eigen::VectorXd& nominal, WeakChoice choice,
                          TorqueFit torque) {
  choice.shift = torque.shift;
  for (int j = 0; j < torque.space.joints(); ++j)
    for (const int other : std::set<int>(torque.shift.begin(), torque.shift.end())) {
      if (other == torque.shift[j] ||
          std::count(torque.shift.begin(), torque.shift.end(), torque.shift[j]) > 1)
        continue;
      WeakChoice changed = choice;
      changed.shift[j] = other;
      TorqueFit tried = fit_again(windows, nominal, changed, torque);
      if (tried.fit.residual_rms[j] > torque.fit.residual_rms[j]) continue;
      choice = changed;
      torque = std::move(tried);
    }
  return torque;
}

}  // namespace

TorqueFit fit_torque(const Gathered& gathered, const ModelChoice& choice, const Eigen::VectorXd& nominal,
                     const Robot& robot, const ParameterSpace& given) {
  TorqueFit out{{}, {}, choice.wanted, {}, {}, with_bend_widths(given, choice.weak)};
  out = fit_again(gathered.windows, nominal, choice.weak, std::move(out));
  out = settle_timing(gathered.windows, nominal, choice.weak, std::move(out));
  out = drop_own_delays(gathered.windows, nominal, choice.weak, std::move(out));
  out = drop_insignificant_extra(nominal, std::move(out));
  out = drop_driving_friction(nominal, std::move(out));
  out = hold_at_zero(nominal, std::move(out));
  out.fit.covariance = with_doubt(choice.width_covariance, std::move(out.fit.covariance));
  out.why_infeasible = what_is_wrong(out, gathered.measurements);
  if (out.why_infeasible.empty()) return out;
  TorqueFit rotors = with_rotors(robot, nominal, out);
  rotors.fit.covariance = with_doubt(choice.width_covariance, std::move(rotors.fit.covariance));
  rotors.why_infeasible = what_is_wrong(rotors, gathered.measurements);
  if (rotors.why_infeasible.empty()) return rotors;
  const Eigen::Index linear = out.space.linear();
  out.fit.parameters.head(linear) =
      nearest_feasible(out.space, robot, out.system, out.fit, out.wanted).head(linear);
  out.fit.residual = out.system.y - out.system.a * out.fit.parameters.head(linear);
  return out;
}

}  // namespace faultline
