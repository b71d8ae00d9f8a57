// SPDX-License-Identifier: MIT
#include "lib/identify/torque_fit.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "lib/identify/feasible/feasible.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr double kSmallRotor = 0.02;      // of the inertia its joint moves
constexpr double kClearlyThere = 4.0;     // standard deviations above zero that rotors and extra terms have
constexpr double kClearlyNegative = 4.0;  // standard deviations below zero that are no doubt any more
constexpr int kTimingRounds = 3;          // at most, in which the timing gives whole samples to the delay
constexpr double kTimingSlack = 0.05;     // samples by which a timing beyond is taken for noise

/// Whether no robot has this parameter below zero.
bool is_not_negative(const ParameterSpace& space, int p) {
  return p < space.rigid() ? space.base[p].is_rotor : p < space.offset(0);
}

/// An inertia that next to that of its joint nobody would miss.
double small_rotor(const ParameterSpace& space, const TorqueFit& torque, int p) {
  const Chain chain = chain_from(space, torque.fit.parameters);
  const int joint = space.base[p].joint;
  return kSmallRotor *
         std::abs(inertia_matrix(chain, JointVector::Zero(space.joints()).eval())(joint, joint));
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

/// Extra terms of which the fit makes what no robot has, or what it does not tell from zero: the one least
/// told first. A ripple's cosine may well be zero.
void drop_doubtful_extra(const ParameterSpace& space, const Eigen::VectorXd& start, TorqueFit& torque) {
  for (;;) {
    int worst = -1;
    double least = kClearlyThere;
    for (int p = space.extra_begin(); p < space.timing(); ++p) {
      const double value = torque.fit.parameters[p], std = std::sqrt(torque.fit.covariance(p, p));
      if (!torque.wanted[p] || is_ripple(space.extra_at(p).kind)) continue;
      const double told = std > 0.0 && is_possible(space.extra_at(p).kind, value) ? value / std : 0.0;
      if (told < least) least = told, worst = p;
    }
    if (worst < 0) return;
    torque.wanted[worst] = false;
    torque.fit = fit_weak_form(torque.system, space, start, torque.wanted);
  }
}

/// Friction that drives its joint is none: bends that outdo the Coulomb friction and skews that outdo the
/// viscous go.
void drop_driving_friction(const ParameterSpace& space, const Eigen::VectorXd& start, TorqueFit& torque) {
  for (int j = 0; j < space.joints(); ++j) {
    const Eigen::VectorXd& p = torque.fit.parameters;
    const bool bend = p[space.bend(j)] < -p[space.coulomb(j)];
    const bool skew = std::abs(p[space.skew(j)]) > p[space.viscous(j)];
    if (!(bend && torque.wanted[space.bend(j)]) && !(skew && torque.wanted[space.skew(j)])) continue;
    if (bend) torque.wanted[space.bend(j)] = false;
    if (skew) torque.wanted[space.skew(j)] = false;
    torque.fit = fit_weak_form(torque.system, space, start, torque.wanted);
  }
}

std::string what_is_wrong(const TorqueFit& torque, const Gathered& gathered, const ParameterSpace& space) {
  const Measurements& m = gathered.measurements;
  return infeasibility(space, torque.fit.parameters, torque.fit.covariance, m.q_low(), m.q_high());
}

/// The same fit with every rotor the robot may have: links without them can come out lighter than nothing.
TorqueFit with_rotors(const TorqueFit& torque, const ParameterSpace& space, const Robot& robot,
                      const Eigen::VectorXd& nominal) {
  TorqueFit out = torque;
  for (int p = 0; p < space.rigid(); ++p)
    if (space.base[p].is_rotor && robot.known.count(space.base[p].name) == 0) out.wanted[p] = true;
  out.fit = fit_weak_form(out.system, space, nominal, out.wanted);
  hold_at_zero(space, nominal, out);
  return out;
}

/// What is free is as doubtful as the friction widths make it.
void add_doubt(const Eigen::MatrixXd& doubt, WeakFit& fit) {
  for (Eigen::Index i = 0; i < doubt.rows(); ++i)
    for (Eigen::Index k = 0; k < doubt.cols(); ++k)
      if (fit.covariance(i, i) > 0.0 && fit.covariance(k, k) > 0.0) fit.covariance(i, k) += doubt(i, k);
}

/// The fit with every joint's torque `later` samples more; as it was where that is beyond what windows hold.
bool delay_all(const WeakSets& windows, const ParameterSpace& space, const Eigen::VectorXd& nominal,
               int later, WeakChoice& choice, TorqueFit& torque) {
  const int earliest = windows.shifts.first + 1, latest = windows.shifts.last;
  const std::vector<int> before = choice.shift;
  for (int& shift : choice.shift) shift = std::clamp(shift + later, earliest, latest);
  if (choice.shift == before) return false;
  torque.system = assemble(windows, choice);
  torque.shift = choice.shift;
  torque.fit = fit_weak_form(torque.system, space, nominal, torque.wanted);
  return true;
}

/// Torque that runs between samples lies between two of them: what the timing says beyond is whole samples of
/// delay, of all joints. A torque held over its sample would be as right with a sample of delay and held
/// backwards; that is said without the delay.
void settle_timing(const WeakSets& windows, const ParameterSpace& space, const Eigen::VectorXd& nominal,
                   WeakChoice choice, TorqueFit& torque) {
  const auto phi = [&] { return torque.fit.parameters[space.timing()]; };
  for (int round = 0; round < kTimingRounds && torque.fit.free[space.timing()]; ++round) {
    const bool inside = phi() > -kTimingSlack && phi() < 1.0 + kTimingSlack;
    if (inside || !delay_all(windows, space, nominal, -static_cast<int>(std::floor(phi())), choice, torque))
      break;
  }
  const bool delayed = *std::min_element(choice.shift.begin(), choice.shift.end()) > 0;
  if (torque.fit.free[space.timing()] && phi() > 1.0 - kTimingSlack && delayed)
    delay_all(windows, space, nominal, -1, choice, torque);
}

/// A delay of its own was chosen with the torque's timing not yet known: half a sample looks like one. A
/// joint keeps it only where none of the others' delays explains its torque as well.
void drop_own_delays(const WeakSets& windows, const ParameterSpace& space, const Eigen::VectorXd& nominal,
                     WeakChoice choice, TorqueFit& torque) {
  choice.shift = torque.shift;
  for (int j = 0; j < space.joints(); ++j)
    for (const int other : std::set<int>(torque.shift.begin(), torque.shift.end())) {
      if (other == torque.shift[j] ||
          std::count(torque.shift.begin(), torque.shift.end(), torque.shift[j]) > 1)
        continue;
      TorqueFit tried = torque;
      WeakChoice changed = choice;
      changed.shift[j] = other;
      tried.system = assemble(windows, changed);
      tried.shift = changed.shift;
      tried.fit = fit_weak_form(tried.system, space, nominal, tried.wanted);
      if (tried.fit.residual_rms[j] > torque.fit.residual_rms[j]) continue;
      choice = changed;
      torque = std::move(tried);
    }
}

}  // namespace

TorqueFit fit_torque(const Gathered& gathered, const ModelChoice& choice, const Eigen::VectorXd& nominal,
                     const Robot& robot, ParameterSpace& space) {
  for (int j = 0; j < space.joints(); ++j)
    space.chain.friction[j].bend_width = weak_width(space, j, choice.weak.bend[j]);
  TorqueFit out{assemble(gathered.windows, choice.weak), {}, choice.wanted, choice.weak.shift, {}};
  out.fit = fit_weak_form(out.system, space, nominal, out.wanted);
  settle_timing(gathered.windows, space, nominal, choice.weak, out);
  drop_own_delays(gathered.windows, space, nominal, choice.weak, out);
  drop_doubtful_extra(space, nominal, out);
  drop_driving_friction(space, nominal, out);
  hold_at_zero(space, nominal, out);
  add_doubt(choice.width_doubt, out.fit);
  const std::string wrong = what_is_wrong(out, gathered, space);
  if (wrong.empty()) return out;
  TorqueFit rotors = with_rotors(out, space, robot, nominal);
  add_doubt(choice.width_doubt, rotors.fit);
  if (what_is_wrong(rotors, gathered, space).empty()) return rotors;
  out.fit.parameters.head(space.linear()) =
      nearest_feasible(space, robot, out.system, out.fit, out.wanted).head(space.linear());
  out.fit.residual = out.system.y - out.system.a * out.fit.parameters.head(space.linear());
  out.not_a_robot = wrong;
  return out;
}

}  // namespace faultline
