// SPDX-License-Identifier: MIT
#include "lib/identify/shooting/shooting_evaluation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/parallel.hpp"
#include "lib/robot/chain.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr double kDiverged = 1e6;  ///< residual that replaces those of a diverged motion

/// Returns the longest step at which the integration follows the friction of `chain` around zero velocity, s.
double stable_step(const Chain& chain, const JointVector& q, const JointVector& torque) {
  const JointMatrix m = inertia_matrix(chain, q);
  const JointMatrix inverse = m.ldlt().solve(JointMatrix::Identity(chain.joints(), chain.joints()));
  double rate = 1e-9;
  for (int j = 0; j < chain.joints(); ++j)
    rate = std::max(
        rate, std::abs(inverse(j, j)) * (steepest(chain.friction[j], torque[j]) - chain.friction[j].viscous));
  for (const SharedDrive& f : chain.shared_drives)
    rate = std::max(rate, f.along.dot(Eigen::MatrixXd(inverse) * f.along) * f.coulomb / f.width);
  return 0.6 / rate;
}

}  // namespace

ShootingEvaluation::ShootingEvaluation(const ShootingProblem& problem)
    : space_(problem.space),
      excerpts_(problem.excerpts),
      free_(problem.free),
      threads_(problem.threads),
      parameters_(problem.start),
      noise_(problem.first_noise()) {
  const Eigen::Index n2 = 2 * space_.joints(), count = static_cast<Eigen::Index>(excerpts_.size());
  variables_.resize(n2 * count + static_cast<Eigen::Index>(free_.size()));
  for (Eigen::Index i = 0; i < count; ++i) variables_.segment(n2 * i, n2) = excerpts_[i].start;
  for (std::size_t k = 0; k < free_.size(); ++k) values()[k] = parameters_[free_[k]];
  robust_.resize(excerpts_.size());
  for (std::size_t i = 0; i < excerpts_.size(); ++i) robust_[i] = excerpts_[i].weight;
  reduced.resize(excerpts_.size());
  const Chain chain = chain_from(space_, parameters_);
  longest_step_s_ = std::min(
      0.01, std::max(0.0006, stable_step(chain, excerpts_[0].start.head(space_.joints()), largest_torque())));
}

JointVector ShootingEvaluation::largest_torque() const {
  JointVector most = JointVector::Zero(space_.joints());
  for (const Excerpt& e : excerpts_) most = most.cwiseMax(e.tau.cwiseAbs().rowwise().maxCoeff());
  return most;
}

double ShootingEvaluation::narrowest_width(int j) const {
  const Chain chain = chain_from(space_, parameters_);
  return std::max(1e-4, 0.5 * chain.friction[j].width * longest_step_s_ /
                            stable_step(chain, excerpts_[0].start.head(space_.joints()), largest_torque()));
}

Eigen::VectorXd ShootingEvaluation::parameters() const {
  Eigen::VectorXd p = parameters_;
  for (std::size_t k = 0; k < free_.size(); ++k) p[free_[k]] = variables_.tail(free_.size())[k];
  return p;
}

void ShootingEvaluation::PrepareForEvaluation(bool jacobians, bool) {
  const SegmentModel model(space_, parameters(), free_, longest_step_s_);
  parallel_for(static_cast<int>(excerpts_.size()), threads_, [&](int i) { evaluate(model, i, jacobians); });
}

std::vector<Eigen::MatrixXd> ShootingEvaluation::residuals() const {
  std::vector<Eigen::MatrixXd> out(excerpts_.size());
  const SegmentModel model(space_, parameters(), free_, longest_step_s_);
  parallel_for(static_cast<int>(excerpts_.size()), threads_, [&](int i) {
    SegmentMotion motion;
    model.run(excerpts_[i], start_of(i), false, motion);
    out[i] = motion.state - excerpts_[i].measured;
    for (Eigen::Index k = 0; k < out[i].size(); ++k)
      if (excerpts_[i].weight(k) == 0.0) out[i](k) = std::numeric_limits<double>::quiet_NaN();
  });
  return out;
}

void ShootingEvaluation::reweight(const std::vector<Eigen::MatrixXd>& residuals,
                                  const Eigen::VectorXd& noise) {
  noise_ = noise;
  for (std::size_t i = 0; i < excerpts_.size(); ++i)
    for (Eigen::Index k = 0; k < residuals[i].cols(); ++k)
      for (Eigen::Index c = 0; c < residuals[i].rows(); ++c) {
        const double u = std::abs(residuals[i](c, k)) / (kShootingOutlierStd * noise[c]);
        robust_[i](c, k) = excerpts_[i].weight(c, k) > 0.0 ? (u > 1.0 ? 1.0 / (u * u) : 1.0) : 0.0;
      }
}

Eigen::VectorXd ShootingEvaluation::start_of(int i) const {
  return variables_.segment(2 * space_.joints() * i, 2 * space_.joints());
}

void ShootingEvaluation::evaluate(const SegmentModel& model, int i, bool jacobians) {
  const Excerpt& e = excerpts_[i];
  SegmentMotion motion;
  model.run(e, start_of(i), jacobians, motion);
  const int n2 = 2 * space_.joints(), width = n2 + static_cast<int>(free_.size());
  std::vector<Eigen::Index> used;
  std::vector<double> weight;
  for (int k = 0; k < e.rows(); ++k)
    for (int c = 0; c < n2; ++c)
      if (robust_[i](c, k) > 0.0) {
        used.push_back(n2 * k + c);
        weight.push_back(std::sqrt(robust_[i](c, k)) / noise_[c]);
      }
  const auto count = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd stacked(count, jacobians ? width + 1 : 1);
  for (Eigen::Index u = 0; u < count; ++u) {
    const double r = weight[u] * (motion.state(used[u]) - e.measured(used[u]));
    stacked(u, stacked.cols() - 1) = std::abs(r) < kDiverged ? r : kDiverged;
  }
  if (jacobians)
    for (int c = 0; c < width; ++c)
      for (Eigen::Index u = 0; u < count; ++u) stacked(u, c) = weight[u] * motion.sensitivity(used[u], c);
  store(reduced[i], stacked, jacobians);
}

void ShootingEvaluation::store(ReducedExcerpt& out, Eigen::MatrixXd& stacked, bool jacobians) const {
  const int n2 = 2 * space_.joints();
  out.residual.setZero(rows());
  if (!jacobians) {
    out.residual[0] = stacked.norm();
    return;
  }
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(rows(), rows());
  if (stacked.allFinite()) {
    const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> qr(stacked);
    const Eigen::Index height = std::min<Eigen::Index>(rows(), stacked.rows());
    factor.topRows(height) = qr.matrixQR().topRows(height).triangularView<Eigen::Upper>();
  }
  out.by_state = factor.leftCols(n2);
  out.by_parameter = factor.middleCols(n2, factor.cols() - n2 - 1);
  out.residual = factor.rightCols<1>();
}

}  // namespace faultline
