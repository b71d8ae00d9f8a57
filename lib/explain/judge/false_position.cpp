// SPDX-License-Identifier: MIT
// The part of judge.hpp for false positions.
#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/core/elementary/elementary.hpp"
#include "lib/explain/judge/judge.hpp"
#include "lib/explain/search/sensor_jumps.hpp"

namespace faultline {
namespace {

using Eigen::VectorXd;

constexpr int kSizeRounds = 3;      // rounds that estimate the size of a false reading
constexpr double kSettled = 0.05;   // share of the size: a round that changes less is the last
constexpr double kHopeless = -5.0;  // nats below which a size is not settled,
constexpr double kFarLess = 0.1;    // share of a rival's nats likewise

/// Sizes of a false reading, rad or m; of a drift in each second.
struct PositionErrorSize {
  double usual = 0.0;  ///< prior standard deviation
  double step = 0.0;   ///< of its numeric derivative
};

PositionErrorSize position_error_size(const LogFit& fit, const FaultClaim& claim) {
  const bool slide = fit.model().rigid.chain.geometry[claim.joint.index()].kind == AxisKind::prismatic;
  if (claim.kind == FaultKind::sensor_bias)
    return slide ? PositionErrorSize{0.02, 2e-4} : PositionErrorSize{0.1, 1e-3};
  return slide ? PositionErrorSize{0.03, 4e-4} : PositionErrorSize{0.1, 2e-3};
}

/// Judges a false reading: corrects the trajectory and computes the residual anew, linear in the size between
/// the last two sizes (the secant method), until the size is settled. A claim without a size starts from
/// zero. A hypothesis that explains far less than its rival is left after its first size, or its second one
/// if the claim has a size, which may be far off.
FaultHypothesis judge_position_error(const LogFit& fit, FaultClaim claim, double rival) {
  const bool bias = claim.kind == FaultKind::sensor_bias;
  const auto [usual, step] = position_error_size(fit, claim);
  FaultHypothesis best;
  double size = claim.size.size() > 0 ? claim.size[0] : 0.0;
  const int round_to_leave = size == 0.0 ? 0 : 1;
  const double enough = std::max(kHopeless, kFarLess * rival);
  // A drift of size zero changes nothing; a jump of size zero still replaces velocities that are computed
  // from the position.
  Stacked at = size == 0.0 && !bias ? fit.residual() : residual_without(fit, claim, size),
          slope = (at - residual_without(fit, claim, size + step)) / step;
  for (int round = 0; round < kSizeRounds; ++round) {
    const double doubt = size == 0.0 ? usual : 0.3 * std::abs(size) + 1e-5;
    FaultColumns columns{StackedColumns(slope), VectorXd::Constant(1, doubt * doubt)};
    std::vector<VectorXd> starts;
    if (fit.has_piece()) starts.push_back(VectorXd::Zero(1));
    Explanation e = fit.explain_with_piece(at, columns, starts, claim.onset_s);
    // Replaces the prior about the size before by that of the size.
    const double price = 0.5 * size * size / (usual * usual) + elementary::log(usual / doubt);
    const double change = e.size[0];
    FaultHypothesis h = hypothesis(fit, claim, std::move(e), price);
    h.size = VectorXd::Constant(1, size + change);
    if (h.gain > best.gain) best = std::move(h);
    if (round >= round_to_leave && best.gain < enough) break;
    const bool settled = std::abs(change) < kSettled * std::abs(size);
    const double moved =
        size == 0.0 ? change : std::clamp(change, -0.5 * std::abs(size), 0.5 * std::abs(size));
    if (settled || moved == 0.0 || round + 1 == kSizeRounds) break;
    size += moved;
    const Stacked next = residual_without(fit, claim, size);
    slope = (at - next) / moved;
    at = next;
  }
  best.at_onset = jump_evidence(fit, best);
  best.gain += best.at_onset;
  return best;
}

}  // namespace

FaultHypothesis judge_false_position(const LogFit& fit, FaultClaim claim, double rival) {
  const bool is_one = fit.log().dq.rows() == 0 || !fit.model().setting.measures_velocity(claim.joint.index());
  FaultHypothesis best = judge_position_error(fit, claim, rival);
  if (claim.velocity_is_true || is_one) return best;
  claim.velocity_is_true = true;
  FaultHypothesis other = judge_position_error(fit, claim, rival);
  return other.gain > best.gain ? other : best;
}

FaultColumns columns_about_healthy(const LogFit& fit, const FaultClaim& claim) {
  if (!falsifies_position(claim.kind)) return columns_of(fit, claim);
  const auto [usual, step] = position_error_size(fit, claim);
  const Stacked without =
      claim.kind == FaultKind::sensor_bias ? residual_without(fit, claim, 0.0) : fit.residual();
  return {StackedColumns((without - residual_without(fit, claim, step)) / step),
          VectorXd::Constant(1, usual * usual)};
}

}  // namespace faultline
