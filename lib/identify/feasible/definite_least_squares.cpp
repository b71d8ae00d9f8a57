// SPDX-License-Identifier: MIT
#include "lib/identify/feasible/definite_least_squares.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/matrix/decompositions.hpp"

namespace faultline {
namespace {

constexpr double kFall = 0.1;       // factor of the prior from one stage to the next
constexpr int kSteps = 60;          // Newton steps in a stage, at most
constexpr int kHalvings = 60;       // of a step, at most
constexpr double kDecrease = 1e-4;  // of the predicted decrease: least decrease by a step (Armijo)
constexpr double kSettled = 1e-10;  // Newton decrement over cost and prior together, ends a stage
constexpr double kRidge = 1e-14;    // of the scaled Hessian's diagonal

Eigen::MatrixXd value(const DefiniteBlock& block, const Eigen::VectorXd& x) {
  return block.value(x.segment(block.first, block.unknowns()));
}

class Problem {
 public:
  Problem(const Eigen::MatrixXd& a, const Eigen::VectorXd& y, const std::vector<DefiniteBlock>& blocks)
      : blocks_(blocks), h_(a.transpose() * a), b_(a.transpose() * y), constant_(0.5 * y.squaredNorm()) {
    for (const DefiniteBlock& block : blocks)
      inverse_nominal_.push_back(block.value(block.nominal).inverse());
  }

  /// Returns the cost; infinite if a block is not positive definite.
  double cost(const Eigen::VectorXd& x, double prior) const {
    double divergence = 0.0;
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      const Eigen::MatrixXd v = value(blocks_[k], x);
      const Eigen::LLT<Eigen::MatrixXd> llt(v);
      if (llt.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
      divergence += inverse_nominal_[k].cwiseProduct(v).sum() -
                    2.0 * Eigen::MatrixXd(llt.matrixL()).diagonal().array().unaryExpr(&elementary::log).sum();
    }
    const double out = 0.5 * x.dot(h_ * x) - b_.dot(x) + constant_ + prior * divergence;
    return std::isfinite(out) ? out : std::numeric_limits<double>::infinity();
  }

  void derivatives(const Eigen::VectorXd& x, double prior, Eigen::VectorXd& gradient,
                   Eigen::MatrixXd& hessian) const {
    gradient = h_ * x - b_;
    hessian = h_;
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      const DefiniteBlock& block = blocks_[k];
      const Eigen::MatrixXd inverse = value(block, x).inverse();
      for (int i = 0; i < block.unknowns(); ++i) {
        const Eigen::MatrixXd turned = inverse * block.basis[i] * inverse;
        gradient[block.first + i] +=
            prior * (inverse_nominal_[k] - inverse).cwiseProduct(block.basis[i]).sum();
        for (int j = 0; j < block.unknowns(); ++j)
          hessian(block.first + i, block.first + j) += prior * turned.cwiseProduct(block.basis[j]).sum();
      }
    }
  }

 private:
  const std::vector<DefiniteBlock>& blocks_;
  std::vector<Eigen::MatrixXd> inverse_nominal_;
  Eigen::MatrixXd h_;
  Eigen::VectorXd b_;
  double constant_;
};

/// Solves H step = -g for unknowns of any scale.
Eigen::VectorXd newton_step(const Eigen::MatrixXd& hessian, const Eigen::VectorXd& gradient) {
  const Eigen::VectorXd scale = hessian.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd h = scale.asDiagonal() * hessian * scale.asDiagonal();
  h.diagonal().array() += kRidge;
  return -scale.cwiseProduct(solve_definite(h, scale.cwiseProduct(gradient)));
}

/// Runs Newton's method with one prior.
void descend(const Problem& problem, double prior, Eigen::VectorXd& x) {
  double cost = problem.cost(x, prior);
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  for (int round = 0; round < kSteps; ++round) {
    problem.derivatives(x, prior, gradient, hessian);
    const Eigen::VectorXd step = newton_step(hessian, gradient);
    const double slope = gradient.dot(step);
    if (!(slope < -kSettled * (std::abs(cost) + prior))) return;
    double size = 1.0, next = cost;
    for (int halving = 0; halving < kHalvings; ++halving, size *= 0.5) {
      next = problem.cost(x + size * step, prior);
      if (next <= cost + kDecrease * size * slope) break;
    }
    if (!(next < cost)) return;
    x += size * step;
    cost = next;
  }
}

}  // namespace

Eigen::MatrixXd DefiniteBlock::value(const Eigen::VectorXd& own_unknowns) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(basis[0].rows(), basis[0].cols());
  for (int i = 0; i < unknowns(); ++i) out += own_unknowns[i] * basis[i];
  return out;
}

Eigen::VectorXd definite_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& y,
                                       const std::vector<DefiniteBlock>& blocks, double prior) {
  const Problem problem(a, y, blocks);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(a.cols());
  for (const DefiniteBlock& block : blocks) x.segment(block.first, block.unknowns()) = block.nominal;
  double now = std::max(prior, problem.cost(x, 0.0));
  while (now > prior) {
    descend(problem, now, x);
    now = std::max(prior, kFall * now);
  }
  descend(problem, prior, x);
  return x;
}

}  // namespace faultline
