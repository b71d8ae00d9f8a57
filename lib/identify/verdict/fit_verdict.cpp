// SPDX-License-Identifier: MIT
#include "lib/identify/verdict/fit_verdict.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "lib/core/matrix/decompositions.hpp"
#include "lib/core/random.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr std::size_t kSpreadFewestLogs = 3;  // the spread of two is too uncertain
constexpr double kWellExplained = 0.95;       // of a joint's torque: less is explained in part only
constexpr double kLightOfRotor =
    0.01;  // of the rotor's inertia: a smaller mass is one on which no gravity acts
constexpr double kLightest = 1e-3, kHeaviest = 300.0;  // kg: bounds of a plausible mass on a prismatic joint

constexpr int kPoses = 200;            // random positions in each range
constexpr double kSurelyNegative = 4;  // standard deviations below zero: clearly negative
constexpr double kRoundedZero = 1e-9;  // of the largest eigenvalue: rounding

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

std::vector<double> r2_of(const std::vector<RowSums>& joints) {
  std::vector<double> out;
  for (const RowSums& sums : joints) out.push_back(sums.r2());
  return out;
}

/// Returns the identification with its torque delays: of the robot in whole samples, none if all are 0, and
/// with the timing.
Identification with_delays(const std::vector<int>& shift, const Gathered& gathered, Identification id) {
  double period = 0.0;
  for (const LogSurvey& survey : gathered.surveys) period = std::max(period, survey.summary.period_s);
  std::vector<double>& whole_s = id.robot.torque_delay_s;
  whole_s.resize(shift.size(), 0.0);
  for (std::size_t j = 0; j < shift.size(); ++j) {
    whole_s[j] += shift[j] * period;
    id.torque_delay_s.push_back(whole_s[j] + (0.5 - id.estimate[id.space.timing()]) * period);
  }
  if (std::all_of(whole_s.begin(), whole_s.end(), [](double s) { return s == 0.0; })) whole_s.clear();
  return id;
}

/// Returns how much logs differ: the standard deviation between fits to single logs, by parameter.
std::vector<double> spread_between_logs(const ModelChoice& choice, const Identification& id) {
  std::vector<double> spread(id.space.count(), std::numeric_limits<double>::quiet_NaN());
  std::vector<int> used;
  for (int log = 0; log < static_cast<int>(choice.spread.cols()); ++log)
    if (!id.logs[log].left_out) used.push_back(log);
  if (used.size() < kSpreadFewestLogs) return spread;
  for (int p = 0; p < id.space.timing(); ++p) {
    if (!choice.wanted[p]) continue;
    const Eigen::ArrayXd values = choice.spread.row(p)(used);
    spread[p] = std::sqrt((values - values.mean()).square().sum() / static_cast<double>(used.size() - 1));
  }
  return spread;
}

/// Returns the torques of every joint, window by window.
std::vector<JointFit> curves_of(const TorqueFit& torque, const ModelChoice& choice, const Gathered& gathered,
                                const Eigen::VectorXd& residual, const Identification& id) {
  std::vector<JointFit> fits(torque.system.joints);
  Eigen::Index row = 0;
  for (int j = 0; j < torque.system.joints; ++j) {
    JointFit& fit = fits[j];
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
  }
  return fits;
}

/// Returns the rotor inertia of the joint that a mass is named after, kg; 0 if it has none.
double rotor_beside(const Identification& id, int mass) {
  const std::string rotor = "jr" + id.space.name(mass).substr(1);
  for (int p = 0; p < id.space.rigid(); ++p)
    if (id.space.base[p].is_rotor && id.space.name(p) == rotor) return id.estimate[p];
  return 0.0;
}

/// Returns `unexplained` if masses are implausible and the robot file gives no mass.
std::optional<FitStatus> implausible(const Identification& id) {
  for (int j = 0; j < id.space.joints(); ++j)
    if (id.robot.known.contains(fmt::format("m{}", Joint::at(j)))) return std::nullopt;
  std::vector<std::string> reasons;
  for (int p = 0; p < id.space.rigid(); ++p) {
    const double mass = id.estimate[p];
    if (!id.space.base[p].is_mass || !(id.covariance(p, p) > 0.0)) continue;
    if (std::abs(mass) < kLightOfRotor * rotor_beside(id, p)) {
      reasons.push_back(fmt::format(
          "{0} shows no weight, it was estimated as {1:.4g} kg: if its axis is horizontal or the order of "
          "axes differs, correct gravity or axes in the robot file, or state {0} under [known]",
          id.space.name(p), mass));
      continue;
    }
    if (mass > kLightest && mass < kHeaviest) continue;
    reasons.push_back(fmt::format(
        "{0} was estimated as {1:.4g} kg: if that is not its mass, the torque is in another unit; if it "
        "is, state it as {0} under [known]",
        id.space.name(p), mass));
  }
  if (reasons.empty()) return std::nullopt;
  return FitStatus{IdentificationStatus::unexplained, fmt::format("{}", fmt::join(reasons, "; "))};
}

std::optional<FitStatus> unexplained(const std::vector<double>& r2, const std::vector<Joint>& still) {
  std::vector<Joint> joints;
  for (int j = 0; j < static_cast<int>(r2.size()); ++j)
    if (!(r2[j] >= kExplained) && !has_joint(still, Joint::at(j))) joints.push_back(Joint::at(j));
  if (joints.empty()) return std::nullopt;
  return FitStatus{
      IdentificationStatus::unexplained,
      fmt::format("the torque of joint {} is not the torque that this robot needs for its motion",
                  fmt::join(joints, ", "))};
}

/// Returns `poorly_explained` for the first moving, driven joint whose torque is explained in part only, or
/// not in held-out windows.
std::optional<FitStatus> poorly_explained(const std::vector<double>& r2, const std::vector<double>& held_out,
                                          const std::vector<Joint>& exempt) {
  for (int j = 0; j < static_cast<int>(r2.size()); ++j) {
    if (has_joint(exempt, Joint::at(j))) continue;
    if (r2[j] >= kWellExplained && held_out[j] >= kWellExplained) continue;
    return FitStatus{
        IdentificationStatus::poorly_explained,
        fmt::format(
            "joint {}: the model explains {:.0f} % of the torque it was fitted to and {:.0f} % of the "
            "held-out torque, so values are rough: {}",
            Joint::at(j), 100.0 * std::max(r2[j], 0.0), 100.0 * std::max(held_out[j], 0.0),
            r2[j] >= kWellExplained ? "the logs are too short for this many parameters; give longer ones"
                                    : "check the load, the gravity and the order of axes, and whether a "
                                      "joint has friction of a kind that the model lacks")};
  }
  return std::nullopt;
}

using Range = std::array<double, 2>;

/// Returns the position range of each joint in the windows of the logs; empty if there are none.
std::vector<Range> ranges_of(const Identification& id) {
  std::vector<Range> ranges;
  for (const JointFit& fit : id.joint_fits) {
    if (fit.q.empty()) return {};
    const auto [low, high] = std::minmax_element(fit.q.begin(), fit.q.end());
    ranges.push_back({*low, *high});
  }
  return ranges;
}

/// The least eigenvalue of the inertia matrix at one position.
struct LeastInertia {
  double value = 0.0;  ///< 0 if none is negative
  double std = 0.0;
  Joint joint{};          ///< the joint with the largest part in that direction
  double at_joint = 0.0;  ///< its inertia while the others are at rest
};

LeastInertia least_inertia(const ParameterSpace& space, const Identification& id, const JointVector& q) {
  const Eigen::MatrixXd matrix = inertia_matrix(chain_from(space, id.estimate), q);
  const SymmetricEigen eigen = symmetric_eigen(matrix);
  Eigen::Index least = 0;
  const double value = eigen.values.minCoeff(&least);
  LeastInertia out;
  if (value >= -kRoundedZero * eigen.values.cwiseAbs().maxCoeff()) return out;
  const Eigen::VectorXd direction = eigen.vectors.col(least);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(id.estimate.size());
  for (int p = 0; p < space.rigid(); ++p) {
    Eigen::VectorXd more = id.estimate;
    more[p] += 1.0;  // the matrix is linear in this parameter
    const Eigen::MatrixXd other = inertia_matrix(chain_from(space, more), q);
    gradient[p] = direction.dot((other - matrix) * direction);
  }
  Eigen::Index j = 0;
  direction.cwiseAbs().maxCoeff(&j);
  out.value = value;
  out.std = std::sqrt(std::max(gradient.dot(id.covariance * gradient), 0.0));
  out.joint = Joint::at(static_cast<int>(j));
  out.at_joint = matrix(j, j);
  return out;
}

/// Returns the worst of some positions; `sure`: only of those with a clearly negative value.
LeastInertia worst_within(const std::vector<Range>& ranges, bool sure, const Identification& id) {
  Random random(1);
  LeastInertia worst;
  for (int k = 0; k < kPoses; ++k) {
    JointVector q(static_cast<Eigen::Index>(ranges.size()));
    for (std::size_t j = 0; j < ranges.size(); ++j) q[j] = random.uniform(ranges[j][0], ranges[j][1]);
    const LeastInertia least = least_inertia(id.space, id, q);
    const bool counts = !sure || least.value + kSurelyNegative * least.std < 0.0;
    if (counts && least.value < worst.value) worst = least;
  }
  return worst;
}

}  // namespace

Identification with_verdict(const TorqueFit& torque, const ModelChoice& choice, const Gathered& gathered,
                            const std::vector<Joint>& undriven, Identification id) {
  const WeakSystem& s = torque.system;
  const std::vector<Joint>& still = gathered.windows.still;
  const Eigen::VectorXd residual = s.y - s.a * id.estimate.head(id.space.linear());
  std::vector<RowSums> joints(s.joints);
  std::vector<std::vector<RowSums>> by_log(id.logs.size(), joints);
  for (Eigen::Index k = 0; k < s.y.size(); ++k) {
    if (s.use[k] == 0.0) continue;
    joints[s.joint[k]].add(s.y[k], residual[k]);
    by_log[s.log[k]][s.joint[k]].add(s.y[k], residual[k]);
  }
  for (const RowSums& joint : joints) id.residual_rms.push_back(joint.rms());
  id.fit_r2 = r2_of(joints);
  for (std::size_t i = 0; i < id.logs.size(); ++i) id.logs[i].fit_r2 = r2_of(by_log[i]);
  id = with_delays(choice.weak.shift, gathered, std::move(id));
  id.between_logs_std = spread_between_logs(choice, id);
  id.joint_fits = curves_of(torque, choice, gathered, residual, id);
  for (const JointFit& fit : id.joint_fits) id.residual_patterns.push_back(residual_pattern(fit));
  id.excitation = motion_excitation(torque, id.joint_fits, id.residual_rms, still);
  id.trends = parameter_trends(torque);
  id.take(unexplained(id.fit_r2, still));
  id.take(implausible(id));
  std::vector<Joint> exempt = still;
  exempt.insert(exempt.end(), undriven.begin(), undriven.end());
  if (id.status == IdentificationStatus::converged)
    id.take(poorly_explained(id.fit_r2, choice.held_out_r2, exempt));
  return id;
}

std::optional<FitStatus> negative_inertia(const Identification& id) {
  std::vector<Range> ranges = ranges_of(id);
  if (ranges.empty()) return std::nullopt;
  LeastInertia worst = worst_within(ranges, false, id);
  if (worst.value == 0.0) {
    for (std::size_t j = 0; j < ranges.size(); ++j)
      if (id.space.chain.geometry[j].kind == AxisKind::revolute)
        ranges[j] = {-std::numbers::pi, std::numbers::pi};
    worst = worst_within(ranges, true, id);
  }
  if (worst.value == 0.0) return std::nullopt;
  const bool turns = id.space.chain.geometry[worst.joint.index()].kind == AxisKind::revolute;
  std::string reason = fmt::format(
      "the inertia of joint {} was estimated as {:.4g} {}, and no robot has a negative one: if the "
      "positions are in another unit, such as revolutions or degrees instead of radians, write the unit of "
      "each q into [log.columns] of the robot file",
      worst.joint, std::min(worst.at_joint, worst.value), turns ? "kg m^2" : "kg");
  return FitStatus{IdentificationStatus::unexplained, std::move(reason)};
}

}  // namespace faultline
