// SPDX-License-Identifier: MIT
#include "lib/identify/physical.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <cmath>
#include <limits>

#include "lib/core/random.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

constexpr double kRank = 1e-7;   ///< of the largest singular value of the relative Jacobian
constexpr double kMoves = 1e-4;  ///< part of a parameter in a direction that changes no torque
constexpr int kStarts = 12;
constexpr int kIterations = 200;
constexpr double kNormal95 = 1.959963984540054;

struct Unknown {
  std::string name;
  double value = 1.0;
  double std = 0.0;    ///< of the fact about it; 0 = none
  bool exact = false;  ///< given, not to be solved for
};

/// The equations beta(psi) = estimate in the logarithms of masses and lengths.
class Equations {
 public:
  Equations(const Robot& robot, const ParameterSpace& space, const Eigen::VectorXd& estimate,
            const Eigen::MatrixXd& covariance, const std::vector<bool>& usable)
      : robot_(robot), space_(space) {
    list_unknowns();
    for (int p = 0; p < space.rigid(); ++p)
      if (usable[p] && !belongs_to_general_link(p)) rows_.push_back(p);
    const Eigen::Index m = static_cast<Eigen::Index>(rows_.size());
    target_.resize(m);
    Eigen::MatrixXd c(m, m);
    for (Eigen::Index i = 0; i < m; ++i) {
      target_[i] = estimate[rows_[i]];
      for (Eigen::Index k = 0; k < m; ++k) c(i, k) = covariance(rows_[i], rows_[k]);
    }
    for (Eigen::Index i = 0; i < m; ++i) c(i, i) += 1e-18 * (1.0 + target_[i] * target_[i]);
    whitener_ = Eigen::MatrixXd::Identity(m, m);
    if (m > 0) c.llt().matrixL().solveInPlace(whitener_);
  }

  std::vector<Unknown> unknowns;
  const Eigen::VectorXd& target() const { return target_; }

  int open() const {
    int count = 0;
    for (const Unknown& u : unknowns) count += u.exact ? 0 : 1;
    return count;
  }

  /// Base parameters of a robot with these unknowns and a mass added at the tip.
  Eigen::VectorXd base(const Eigen::VectorXd& log_open, double payload) const {
    Robot robot = robot_;
    Eigen::Index next = 0;
    std::vector<double> mass(robot.joints(), 0.0), length = robot.chain.length;
    for (const Unknown& u : unknowns) {
      const double value = u.exact ? u.value : std::exp(log_open[next++]);
      const int link = std::stoi(u.name.substr(1)) - 1;
      (u.name[0] == 'm' ? mass : length)[link] = value;
      if (robot.shapes[link] == LinkShape::general) set_parameter(robot, u.name, value);
    }
    mass.back() += payload;
    set_masses_and_lengths(robot, mass, length);
    if (payload > 0.0 && robot.shapes.back() != LinkShape::point) robot.chain.links.back().mass += payload;
    const Eigen::VectorXd all = parameters_of(space_, robot.chain, 0.0);
    Eigen::VectorXd out(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) out[i] = all[rows_[i]];
    return out;
  }

  Eigen::MatrixXd base_slopes(const Eigen::VectorXd& x, double payload) const {
    Eigen::MatrixXd j(rows_.size(), x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      Eigen::VectorXd up = x, down = x;
      up[k] += 1e-5;
      down[k] -= 1e-5;
      j.col(k) = (base(up, payload) - base(down, payload)) / 2e-5;
    }
    return j;
  }

  /// Whitened residual and slopes, facts with doubt below the base parameters.
  void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* j) const {
    const Eigen::Index m = target_.size();
    r.setZero(m + x.size());
    r.head(m) = whitener_ * (base(x, 0.0) - target_);
    if (j) j->setZero(m + x.size(), x.size());
    if (j) j->topRows(m) = whitener_ * base_slopes(x, 0.0);
    Eigen::Index k = 0;
    for (const Unknown& u : unknowns) {
      if (u.exact) continue;
      if (u.std > 0.0) {
        r[m + k] = (std::exp(x[k]) - u.value) / u.std;
        if (j) (*j)(m + k, k) = std::exp(x[k]) / u.std;
      }
      ++k;
    }
  }

 private:
  bool belongs_to_general_link(int p) const {
    const std::string& name = space_.base[p].name;
    if (!std::isdigit(static_cast<unsigned char>(name.back())) || space_.base[p].is_mass) return false;
    return robot_.shapes[name.back() - '1'] == LinkShape::general;
  }

  void list_unknowns() {
    for (const char* kind : {"m", "l"})
      for (int i = 0; i < robot_.joints(); ++i) {
        if (*kind == 'l' && robot_.shapes[i] != LinkShape::rod) continue;
        Unknown u{fmt::format("{}{}", kind, i + 1), 1.0, 0.0, false};
        if (const auto it = robot_.known.find(u.name); it != robot_.known.end()) {
          u.value = it->second.value;
          u.std = it->second.std;
          u.exact = u.std == 0.0;
        }
        unknowns.push_back(u);
      }
  }

  const Robot& robot_;
  const ParameterSpace& space_;
  std::vector<int> rows_;
  Eigen::VectorXd target_;
  Eigen::MatrixXd whitener_;
};

/// Levenberg and Marquardt from one start; returns the cost.
double descend(const Equations& equations, Eigen::VectorXd& x) {
  Eigen::VectorXd r;
  Eigen::MatrixXd j;
  equations.evaluate(x, r, &j);
  double cost = r.squaredNorm(), damping = 1e-3;
  for (int i = 0; i < kIterations && cost > 1e-16; ++i) {
    Eigen::MatrixXd h = j.transpose() * j;
    h.diagonal() += damping * (h.diagonal().array() + 1e-12 * h.trace()).matrix();
    const Eigen::VectorXd step = -h.ldlt().solve(j.transpose() * r);
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

Eigen::VectorXd solve(const Equations& equations) {
  Random random(7);
  Eigen::VectorXd best;
  double best_cost = std::numeric_limits<double>::infinity();
  const double scale =
      equations.target().size() > 0 ? std::log(equations.target().cwiseAbs().maxCoeff() + 1e-6) : 0.0;
  for (int s = 0; s < kStarts; ++s) {
    Eigen::VectorXd x(equations.open());
    Eigen::Index k = 0;
    for (const Unknown& u : equations.unknowns) {
      if (u.exact) continue;
      x[k++] = u.std > 0.0 ? std::log(std::max(u.value, 1e-6))
                           : (u.name[0] == 'm' ? scale : -0.7) + (s > 0 ? random.uniform(-1.5, 1.5) : 0.0);
    }
    const double cost = descend(equations, x);
    if (cost < 0.5 * best_cost) best = x, best_cost = cost;
    if (best_cost < 1.0) break;
  }
  return best;
}

/// How far each open unknown can move without changing what `rows` says (relative slopes).
Eigen::VectorXd freedom(const Eigen::MatrixXd& rows) {
  const Eigen::Index n = rows.cols();
  Eigen::VectorXd out = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(std::max(rows.rows(), n), n);
  padded.topRows(rows.rows()) = rows;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(padded, Eigen::ComputeFullV);
  for (Eigen::Index k = 0; k < n; ++k)
    if (svd.singularValues()[k] <= kRank * std::max(svd.singularValues()[0], 1e-300))
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

/// The facts any one of which would determine unknown `p`.
std::string missing_datum(const Equations& equations, const Eigen::MatrixXd& rows,
                          const Eigen::MatrixXd& loaded, Eigen::Index p) {
  std::vector<std::string> facts;
  Eigen::Index k = 0;
  for (const char* kind : {"l", "m"}) {
    k = 0;
    for (const Unknown& u : equations.unknowns) {
      if (u.exact) continue;
      if (u.name[0] == *kind && freedom(with_row(rows, k))[p] < kMoves) facts.push_back(u.name);
      ++k;
    }
  }
  Eigen::MatrixXd both(rows.rows() + loaded.rows(), rows.cols());
  both << rows, loaded;
  const bool payload_helps = freedom(both)[p] < kMoves;
  if (facts.empty() && !payload_helps)
    return "these motions do not determine it, whatever one other fact is given";
  if (facts.empty()) return "give a second log with a known payload";
  return fmt::format("give {}{}", join_or(facts),
                     payload_helps ? ", or a second log with a known payload" : "");
}

Eigen::MatrixXd relative(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& base) {
  const double scale = 1e-9 + 1e-6 * base.cwiseAbs().maxCoeff();
  return base.cwiseAbs().cwiseMax(scale).cwiseInverse().asDiagonal() * slopes;
}

}  // namespace

PhysicalFit physical_parameters(const Robot& robot, const ParameterSpace& space,
                                const Eigen::VectorXd& estimate, const Eigen::MatrixXd& covariance,
                                const std::vector<bool>& usable) {
  PhysicalFit fit;
  const Equations equations(robot, space, estimate, covariance, usable);
  const bool nothing = equations.target().size() == 0 || equations.open() == 0;
  const Eigen::VectorXd x = nothing ? Eigen::VectorXd::Zero(equations.open()) : solve(equations);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(0, x.size()), loaded = rows, j;
  Eigen::VectorXd free = Eigen::VectorXd::Ones(x.size()), spread = free, r;
  if (!nothing) {
    rows = relative(equations.base_slopes(x, 0.0), equations.base(x, 0.0));
    loaded = relative(equations.base_slopes(x, 1.0), equations.base(x, 1.0));
    Eigen::Index k = 0;
    for (const Unknown& u : equations.unknowns) {
      if (u.exact) continue;
      if (u.std > 0.0) rows = with_row(rows, k);
      ++k;
    }
    free = freedom(rows);
    equations.evaluate(x, r, &j);
    spread = (j.transpose() * j)
                 .completeOrthogonalDecomposition()
                 .pseudoInverse()
                 .diagonal()
                 .cwiseMax(0.0)
                 .cwiseSqrt();
  }
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> lengths = robot.chain.length;
  bool all_lengths = true;
  Eigen::Index k = 0;
  for (const Unknown& u : equations.unknowns) {
    const bool is_length = u.name[0] == 'l';
    ParameterEstimate e;
    e.name = u.name;
    e.unit = is_length ? "m" : "kg";
    e.identifiable = u.exact || free[k] < kMoves;
    e.value = u.exact ? u.value : e.identifiable ? std::exp(x[k]) : kNone;
    e.std = u.exact ? 0.0 : e.identifiable ? e.value * spread[k] : kNone;
    e.ci95 = {e.value - kNormal95 * e.std, e.value + kNormal95 * e.std};
    if (!e.identifiable) e.why_not = missing_datum(equations, rows, loaded, k);
    if (is_length) lengths[std::stoi(u.name.substr(1)) - 1] = e.value;
    if (is_length && !e.identifiable) all_lengths = false;
    if (!u.exact) ++k;
    fit.parameters.push_back(std::move(e));
  }
  if (all_lengths) fit.lengths = lengths;
  return fit;
}

}  // namespace faultline
