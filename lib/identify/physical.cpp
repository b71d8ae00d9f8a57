// SPDX-License-Identifier: MIT
#include "lib/identify/physical.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/matrix/decompositions.hpp"
#include "lib/core/random.hpp"
#include "lib/core/statistics.hpp"
#include "lib/identify/physical_equations.hpp"

namespace faultline {
namespace {

constexpr double kPhysicalRank = 1e-7;  ///< of the largest singular value of the relative Jacobian
constexpr double kMoves = 1e-4;         ///< part of a parameter in a direction that changes no torque
constexpr double kShortest_m = 0.02, kLongest_m = 10.0;  // of a link: a guess outside is no plausible length
constexpr int kStarts = 12;       // at most, random except the first: the cost may have several minima
constexpr int kIterations = 200;  // of Levenberg and Marquardt from one start, at most

/// Minimises by Levenberg and Marquardt from one start; returns the cost.
double descend(const PhysicalEquations& equations, Eigen::VectorXd& x) {
  Eigen::VectorXd r;
  Eigen::MatrixXd j;
  equations.evaluate(x, r, &j);
  double cost = r.squaredNorm(), damping = 1e-3;
  for (int i = 0; i < kIterations && cost > 1e-16; ++i) {
    Eigen::MatrixXd h = j.transpose() * j;
    h.diagonal() += damping * (h.diagonal().array() + 1e-12 * h.trace()).matrix();
    const Eigen::VectorXd step = -solve_definite(h, j.transpose() * r);
    const Eigen::VectorXd next = x + step.cwiseMax(-1.0).cwiseMin(1.0);
    Eigen::VectorXd r_next;
    equations.evaluate(next, r_next, nullptr);
    if (r_next.squaredNorm() < cost) {
      const bool small = step.norm() < 1e-10;
      x = next;
      cost = r_next.squaredNorm();
      equations.evaluate(x, r, &j);
      damping = std::max(1e-12, 0.2 * damping);
      if (small) break;
    } else if ((damping *= 5.0) > 1e12) {
      break;
    }
  }
  return cost;
}

Eigen::VectorXd solve(const PhysicalEquations& equations) {
  Random random(7);
  Eigen::VectorXd best;
  double best_cost = std::numeric_limits<double>::infinity();
  const double scale = elementary::log(equations.scale() + 1e-6);
  for (int s = 0; s < kStarts; ++s) {
    Eigen::VectorXd x(equations.open().size());
    Eigen::Index k = 0;
    for (const PhysicalUnknown& u : equations.open())
      x[k++] = u.std > 0.0 ? elementary::log(std::max(u.value, 1e-6))
                           : (u.kind == 'm' ? scale : -0.7) + (s > 0 ? random.uniform(-1.5, 1.5) : 0.0);
    const double cost = descend(equations, x);
    if (best.size() == 0) best = x;  // no cost is finite if the covariance is invalid
    if (cost < 0.5 * best_cost) best = x, best_cost = cost;
    if (best_cost < 1.0) break;
  }
  return best;
}

/// Returns the part of each open unknown in directions that leave all `rows` (relative slopes) unchanged.
Eigen::VectorXd freedom(const Eigen::MatrixXd& rows) {
  const Eigen::Index n = rows.cols();
  Eigen::VectorXd out = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(std::max(rows.rows(), n), n);
  padded.topRows(rows.rows()) = rows;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(padded, Eigen::ComputeFullV);
  for (Eigen::Index k = 0; k < n; ++k)
    if (svd.singularValues()[k] <= kPhysicalRank * std::max(svd.singularValues()[0], 1e-300))
      out += svd.matrixV().col(k).cwiseAbs2();
  return out.cwiseSqrt();
}

Eigen::MatrixXd with_row(const Eigen::MatrixXd& rows, Eigen::Index unknown) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(rows.rows() + 1, rows.cols());
  out.topRows(rows.rows()) = rows;
  out(rows.rows(), unknown) = 1.0;
  return out;
}

std::string join_or(const std::vector<std::string>& words) {
  if (words.size() < 2) return words.empty() ? "" : words[0];
  return fmt::format("{} or {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

/// Returns the facts any one of which would determine unknown `p`, as a sentence.
std::string missing_datum(const PhysicalEquations& equations, const Eigen::MatrixXd& rows,
                          const Eigen::MatrixXd& loaded, Eigen::Index p) {
  std::vector<std::string> facts;
  for (const char kind : {'l', 'm'}) {
    Eigen::Index k = 0;
    for (const PhysicalUnknown& u : equations.open()) {
      if (u.kind == kind && freedom(with_row(rows, k))[p] < kMoves) facts.push_back(u.name);
      ++k;
    }
  }
  Eigen::MatrixXd both(rows.rows() + loaded.rows(), rows.cols());
  both << rows, loaded;
  const bool payload_helps = freedom(both)[p] < kMoves;
  if (facts.empty() && !payload_helps)
    return "these motions do not determine it, and no single further length, mass or payload would";
  if (facts.empty()) return "give a second log with a known payload";
  return fmt::format("give {}{}", join_or(facts),
                     payload_helps ? ", or a second log with a known payload" : "");
}

/// The solution, and which unknowns it determines.
struct Solution {
  Eigen::VectorXd log_value, spread, freedom;  ///< of the open unknowns; spread is relative
  Eigen::MatrixXd rows, loaded;                ///< relative slopes, as they are and for a log with 1 kg
  double contradiction = 1.0;                  ///< PhysicalFit::contradiction
};

Solution solve_and_judge(const PhysicalEquations& equations) {
  const auto open = static_cast<Eigen::Index>(equations.open().size());
  Solution s;
  s.log_value.setZero(open);
  s.spread = s.freedom = Eigen::VectorXd::Ones(open);
  s.rows = s.loaded = Eigen::MatrixXd::Zero(0, open);
  if (open == 0 || equations.rows() == 0) return s;
  s.log_value = solve(equations);
  s.rows = equations.relative_slopes(s.log_value);
  s.loaded = equations.relative_slopes(s.log_value, 0, 1.0);
  for (Eigen::Index k = 0; k < open; ++k)
    if (equations.open()[k].std > 0.0) s.rows = with_row(s.rows, k);
  s.freedom = freedom(s.rows);
  Eigen::VectorXd r;
  Eigen::MatrixXd j;
  equations.evaluate(s.log_value, r, &j);
  const Eigen::MatrixXd information = j.transpose() * j;
  const Eigen::MatrixXd covariance = information.completeOrthogonalDecomposition().pseudoInverse();
  if (const auto more = static_cast<double>(r.size() - open); more > 0.0)
    s.contradiction = std::sqrt(std::max(1.0, r.squaredNorm() / more));  // Birge's ratio
  s.spread = s.contradiction * covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  return s;
}

ParameterEstimate given(const PhysicalUnknown& u) {
  return {u.name, u.value, 0.0, {u.value, u.value}, "", true, "", ""};
}

ParameterEstimate solved(const PhysicalEquations& equations, const PhysicalUnknown& u, const Solution& s,
                         Eigen::Index k) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  ParameterEstimate e{u.name, kNone, kNone, {kNone, kNone}, "", s.freedom[k] < kMoves, "", ""};
  if (!e.identifiable) {
    e.why_not = missing_datum(equations, s.rows, s.loaded, k);
    return e;
  }
  const double doubt = kNormal95 * s.spread[k];
  if (doubt >= 1.0) {
    e.identifiable = false;
    e.why_not = fmt::format(
        "these logs determine it only to within {:.0f} %; give faster ones, or more of them", 100.0 * doubt);
    return e;
  }
  e.value = elementary::exp(s.log_value[k]);
  e.std = e.value * s.spread[k];
  e.ci95 = {e.value * (1.0 - doubt), e.value * (1.0 + doubt)};
  return e;
}

/// Uses a guessed length if it is plausible.
void guess_length(const PhysicalUnknown& u, double length, PhysicalFit& fit) {
  if (!(length > kShortest_m && length < kLongest_m)) return;
  fit.lengths[u.index] = length;
  fit.guessed_lengths.push_back(fmt::format("{} (some {:.2g} m)", u.name, length));
}

}  // namespace

PhysicalFit physical_parameters(const Robot& robot, const ParameterSpace& space,
                                std::span<const BaseEstimate> estimates) {
  const PhysicalEquations equations(robot, space, estimates);
  const Solution solution = solve_and_judge(equations);
  PhysicalFit fit;
  fit.contradiction = solution.contradiction;
  fit.lengths = robot.chain.length;
  Eigen::Index next = 0;
  for (const PhysicalUnknown& u : equations.unknowns()) {
    const Eigen::Index k = u.exact ? -1 : next++;
    if (u.kind == 'p') continue;
    ParameterEstimate e = u.exact ? given(u) : solved(equations, u, solution, k);
    e.unit = u.kind == 'l' ? "m" : "kg";
    if (u.kind == 'l' && e.identifiable) fit.lengths[u.index] = e.value;
    if (u.kind == 'l' && !e.identifiable) guess_length(u, elementary::exp(solution.log_value[k]), fit);
    if (k >= 0 && !e.identifiable && solution.freedom[k] < kMoves) fit.hardly_identifiable.push_back(u.name);
    fit.parameters.push_back(std::move(e));
  }
  return fit;
}

}  // namespace faultline
