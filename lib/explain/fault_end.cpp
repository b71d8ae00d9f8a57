// SPDX-License-Identifier: MIT
#include "lib/explain/fault_end.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/statistics.hpp"
#include "lib/explain/search/search.hpp"
#include "lib/explain/search/sensor_jumps.hpp"

namespace faultline {
namespace {

using Eigen::VectorXd;

constexpr double kAbsentShare = 0.7;    // share of the evidence that an absent fault would give
constexpr double kSurelyLasts_s = 5.0;  // s after the onset or the start of the log in which the fault lasts
constexpr int kRestRows = 8;            // rows that give the position of a locked joint
constexpr int kMovesRows = 3;           // rows in succession that show that it moves again
constexpr double kTakenBack = 0.3;      // share of a false reading's size by which the jump back may differ

/// Returns when a joint (from 0) that is locked from `from_s` on moves again, with its spring or without,
/// since the lock may be on either side of it.
std::optional<double> moves_from(const LogFit& fit, int joint, double from_s) {
  const auto [place, tolerance] = standstill(fit, joint);
  const VectorXd q = fit.rows().q.col(joint);
  const int first = fit.first_row(from_s);
  const int rest_rows = std::min(kRestRows, fit.count() - first);
  if (rest_rows < kMovesRows) return std::nullopt;
  const auto rest_of = [&](const VectorXd& values) {
    return upper_median({values.data() + first, values.data() + first + rest_rows});
  };
  const double rest = rest_of(place), q_rest = rest_of(q);
  int moving = 0;
  for (int k = first; k < fit.count(); ++k) {
    const double off = std::min(std::abs(place[k] - rest), std::abs(q[k] - q_rest));
    moving = off > tolerance ? moving + 1 : 0;
    if (moving == kMovesRows) return fit.time_s()[k - kMovesRows + 1];
  }
  return std::nullopt;
}

/// Returns when an encoder that is stuck from `from_s` on gives another code; `from_s` if it is not stuck.
std::optional<double> reads_again_from(const LogFit& fit, int joint, double from_s) {
  for (const RepeatedCode& run : repeated_codes(fit, joint))
    if (run.onset_s <= from_s && run.end_s > from_s)
      return run.end_s < kNeverEnds ? std::optional(run.end_s) : std::nullopt;
  return from_s;
}

/// Returns when a jump of the position reverses a false reading.
std::optional<double> taken_back_at(const LogFit& fit, const FaultClaim& claim) {
  std::optional<double> first;
  for (const SensorJump& jump : sensor_jumps(fit, claim.joint - 1)) {
    const double error = claim.kind == FaultKind::sensor_drift
                             ? claim.size[0] * (jump.onset_s - claim.onset_s)
                             : claim.size[0];
    if (std::abs(jump.size + error) > kTakenBack * std::abs(error)) continue;
    if (!first || jump.onset_s < *first) first = jump.onset_s;
  }
  return first;
}

/// A known fault and the index of its first size among the effects of the log.
struct KnownFault {
  const FaultClaim& claim;
  Eigen::Index begin = 0;

  Eigen::Index sizes() const { return claim.size.size(); }
};

/// Returns the whitened residuals with the fault and without it. The effects are estimated from the rows
/// before `until_s`, up to which the fault is assumed to last: rows after its end would bias the effects of
/// the day.
WithAndWithout with_and_without(const LogFit& fit, const KnownFault& fault, double until_s) {
  const VectorXd effects = fit.day_before(until_s);
  Stacked torque = fit.residual() - fit.day_torque(effects);
  if (fit.healthy().piece_level.size() > 0) torque -= fit.piece_torque(fit.healthy().piece_level);
  WithAndWithout out;
  out.with = fit.whitened(torque);
  VectorXd sizes = VectorXd::Zero(effects.size());
  sizes.segment(fault.begin, fault.sizes()) = fault.claim.size + effects.segment(fault.begin, fault.sizes());
  out.without = out.with + fit.white_effects().times(sizes);
  return out;
}

std::optional<double> end_of(const LogFit& fit, const KnownFault& fault) {
  const FaultClaim& claim = fault.claim;
  const double from_s = std::max(fit.log().time_s(0), claim.onset_s + reach_s(fit.model().setting));
  if (claim.kind == FaultKind::locked) return moves_from(fit, claim.joint - 1, from_s);
  if (claim.kind == FaultKind::stuck_encoder) return reads_again_from(fit, claim.joint - 1, from_s);
  if (falsifies_position(claim.kind))
    if (const std::optional<double> back = taken_back_at(fit, claim)) return back;
  return absent_from_s(fit, with_and_without(fit, fault, from_s + kSurelyLasts_s), from_s);
}

}  // namespace

std::optional<double> absent_from_s(const LogFit& fit, const WithAndWithout& left, double from_s) {
  double square = 0.0, count = 0.0;
  for (const double z : left.with)
    if (!std::isnan(z)) square += z * z, count += 1.0;
  const double enough = kEndEvidence * std::max(1.0, square / std::max(1.0, count));
  double absent = 0.0, possible = 0.0, since = 0.0;
  for (int k = 0; k < fit.count(); ++k) {
    if (fit.time_s()[k] <= from_s) continue;
    if (absent <= 0.0) absent = possible = 0.0, since = fit.time_s()[k];
    for (int j = 0; j < fit.joints(); ++j) {
      const double with = left.with[j * fit.count() + k], without = left.without[j * fit.count() + k];
      if (std::isnan(with)) continue;
      absent += 0.5 * (with * with - without * without);
      possible += 0.5 * (with - without) * (with - without);
    }
    const bool is_absent = absent > enough && absent > kAbsentShare * possible;
    if (is_absent && fit.time_s()[k] >= since + kLeastStay_s) return since;
  }
  return std::nullopt;
}

std::vector<FaultClaim> followed(const UniformLog& log, const BalanceModel& model,
                                 std::vector<FaultClaim> lasting) {
  if (std::all_of(lasting.begin(), lasting.end(), [](const FaultClaim& c) { return c.end_s < kNeverEnds; }))
    return lasting;
  const LogFit fit(log, model, lasting);
  Eigen::Index begin = model.day_variance.size();
  for (FaultClaim& claim : lasting) {
    const KnownFault fault{claim, begin};
    if (!silences(claim.kind)) begin += fault.sizes();
    if (claim.end_s < kNeverEnds) continue;
    if (const std::optional<double> end_s = end_of(fit, fault))
      claim.end_s = *end_s;
    else if (falsifies_position(claim.kind))
      claim.size += fit.healthy().day.segment(fault.begin, fault.sizes());
  }
  return lasting;
}

}  // namespace faultline
