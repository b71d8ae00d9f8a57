// SPDX-License-Identifier: MIT
#include "lib/explain/least_found.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/explain/coarse/coarse_judge.hpp"
#include "lib/explain/judge/judge.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kOfTen = 1.2816;  // 90 % quantile of a standard normal variable: found nine times of ten
constexpr double kNoInformation = 1e-9;  // share of the prior's precision: less is no information

/// Posterior and prior of the sizes of a hypothesis, given the rows of a log; empty if they cannot show it.
struct SizeKnowledge {
  MatrixXd covariance;
  VectorXd variance;  ///< prior
};

/// Returns the direction of the size that reports name among the sizes of a hypothesis.
VectorXd named_size(const FaultLabel& label, Eigen::Index sizes) {
  VectorXd out = VectorXd::Zero(sizes);
  switch (label.kind) {
    case FaultKind::friction_increase:
      out[1] = 1.0;  // dry, after viscous
      break;
    case FaultKind::collision:
      out[label.joint.index()] = 1.0 / kUsualPush_s;  // a steady force on each joint comes first
      break;
    default:
      out[0] = 1.0;
  }
  return out;
}

FaultClaim claim_of(const FaultLabel& label, double onset_s) {
  FaultClaim out{label.kind, label.joint, onset_s};
  if (label.kind == FaultKind::collision) out.end_s = onset_s + kUsualPush_s;
  return out;
}

SizeKnowledge knowledge(const LogFit& fit, const FaultClaim& claim) {
  const bool is_linear = claim.kind != FaultKind::collision && !falsifies_position(claim.kind);
  if (is_linear && linear_of(fit.linear(), claim) == nullptr) return {};
  const FaultColumns columns = columns_about_healthy(fit, claim);
  return {fit.explain(fit.residual(), columns, {}).size_covariance, columns.variance};
}

SizeKnowledge knowledge(const CoarseLog& log, const FaultClaim& claim) {
  const std::optional<CoarseExplanation> e = judge_coarse(log, guess_of(claim), {});
  if (!e) return {};
  return {e->size_covariance, prior_of_sizes(*log.model, claim.kind, claim.joint).cwiseAbs2()};
}

template <typename Fitted>
std::vector<LeastFound> of_each(const Fitted& fitted, const std::vector<FaultLabel>& labels,
                                const EvidenceLimits& limits, double onset_s) {
  std::vector<LeastFound> out;
  for (const FaultLabel& label : labels) {
    if (describe(label.kind).size_count == 0) continue;
    const auto [covariance, variance] = knowledge(fitted, claim_of(label, onset_s));
    double size = std::numeric_limits<double>::infinity();
    if (variance.size() > 0 && covariance.rows() == variance.size())
      size =
          least_size_found(covariance, variance, named_size(label, variance.size()), limits.of(label.kind));
    const double least = label.kind == FaultKind::torque_loss ? kLeastLoss : 0.0;
    out.push_back({label, std::max(size, least)});
  }
  return out;
}

}  // namespace

double least_size_found(const MatrixXd& covariance, const VectorXd& variance, const VectorXd& direction,
                        double limit) {
  const VectorXd precision = variance.cwiseInverse();
  const MatrixXd information = covariance.inverse() - MatrixXd(precision.asDiagonal());
  const VectorXd along = information * direction;
  const double each = along.dot(covariance * along);  // twice the evidence of a size of one without noise
  if (!(each > kNoInformation * direction.cwiseAbs2().dot(precision)))
    return std::numeric_limits<double>::infinity();
  const double price = -0.5 * elementary::log((covariance * precision.asDiagonal()).determinant());
  return (kOfTen + std::sqrt(2.0 * (limit + price))) / std::sqrt(each);
}

std::vector<LeastFound> least_found(const UniformLog& healthy, const ExplainModel& model,
                                    const std::vector<FaultLabel>& labels) {
  return least_found(healthy, model, labels, healthy.time_s(0.5 * healthy.rows()));
}

std::vector<LeastFound> least_found(const UniformLog& healthy, const ExplainModel& model,
                                    const std::vector<FaultLabel>& labels, double onset_s) {
  if (!can_explain(healthy, model.robot)) return {};
  if (const auto* steps = std::get_if<OneStepModel>(&model.robot)) {
    const std::optional<CoarseLog> log = followed_log(healthy, *steps);
    return log ? of_each(*log, labels, model.limits, onset_s) : std::vector<LeastFound>{};
  }
  const LogFit fit(averaged_as(healthy, model.robot), std::get<BalanceModel>(model.robot));
  return of_each(fit, labels, model.limits, onset_s);
}

}  // namespace faultline
