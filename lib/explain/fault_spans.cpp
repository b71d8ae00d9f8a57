// SPDX-License-Identifier: MIT
#include "lib/explain/fault_spans.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/balance/likely_states.hpp"
#include "lib/balance/regress.hpp"
#include "lib/core/statistics.hpp"
#include "lib/explain/search/sensor_jumps.hpp"
#include "lib/explain/search/standstill.hpp"
#include "lib/explain/search/white_search.hpp"

namespace faultline {
namespace {

using Eigen::VectorXd;

constexpr int kRounds = 6;              // of spans and size in turn, at most
constexpr double kAbsentShare = 0.7;    // share of the evidence that an absent fault would give
constexpr double kSurelyLasts_s = 5.0;  // s after the onset or the start of the log in which the fault lasts

/// The log explained by a fault that is present in some spans.
struct SpanFit {
  VectorXd size;
  Stacked absent;       ///< whitened residuals without the fault
  double square = 1.0;  ///< mean square of the residuals
};

FaultColumns columns_in(const LogFit& fit, const LinearFault& fault, const std::vector<FaultSpan>& spans) {
  FaultColumns out = fault.columns;
  out.column.setZero();
  for (const FaultSpan& span : spans)
    out.column += fit.between(fault.columns, span.onset_s, span.end_s).column;
  return out;
}

Explanation explained(const LogFit& fit, const LinearFault& fault, const std::vector<FaultSpan>& spans) {
  return fit.explain_with_piece(fit.residual(), columns_in(fit, fault, spans), fault.starts,
                                spans.front().onset_s);
}

/// Returns the fit with the effects of the day that explain the log best beside the fault or, with `change`,
/// with those that the rows before the change show.
SpanFit fit_in(const LogFit& fit, const LinearFault& fault, const std::vector<FaultSpan>& spans,
               const FreeForm* change) {
  if (change == nullptr) {
    const Explanation e = explained(fit, fault, spans);
    return {e.size, fit.residual_without_fault(e), e.mean_square()};
  }
  const FaultColumns columns = columns_in(fit, fault, spans);
  const Regression sizes =
      regress(normal_equations(fit.whitened(columns.column), change->left), columns.variance.cwiseInverse());
  return {sizes.estimate, change->left, sizes.left / static_cast<double>(change->left.size())};
}

/// Returns the nats, by row, by which the row is more likely without the fault than with it.
VectorXd evidence_of_absence(const LogFit& fit, const StackedColumns& white, const SpanFit& by) {
  const Stacked torque = white * by.size;
  VectorXd out = VectorXd::Zero(fit.count());
  for (int k = 0; k < fit.count(); ++k)
    for (int j = 0; j < fit.joints(); ++j) {
      const Eigen::Index at = j * fit.count() + k;
      const double absent = by.absent[at], present = absent - torque[at];
      if (!std::isnan(absent)) out[k] += 0.5 * (present * present - absent * absent);
    }
  return out;
}

/// Returns by row 1 if the fault is present, else 0. Each change costs `price` nats; the fault begins with
/// the row before `first` at the earliest.
std::vector<char> states_of(const VectorXd& absence, int first, double price) {
  Eigen::MatrixX2d nats(absence.size(), 2);
  nats << -absence, VectorXd::Zero(absence.size());
  nats.col(1).head(first - 1).setConstant(std::numeric_limits<double>::infinity());
  nats(first - 1, 1) = nats(first - 1, 0);
  return likely_states(nats, price);
}

/// Returns the spans of the states; times shorter than kLeastStay_s get the state around them.
std::vector<FaultSpan> spans_of(const LogFit& fit, const std::vector<char>& present) {
  std::vector<FaultSpan> out;
  const double half_s = 0.5 * fit.model().setting.row_s();
  for (int k = 0; k < fit.count(); ++k) {
    const bool was = k > 0 && present[k - 1];
    if (present[k] && !was) {
      const double onset_s = fit.time_s()[k] - half_s;
      if (!out.empty() && onset_s - out.back().end_s < kLeastStay_s)
        out.back().end_s = kNeverEnds;
      else
        out.push_back({onset_s, kNeverEnds});
    }
    if (!present[k] && was) out.back().end_s = fit.time_s()[k] - half_s;
  }
  std::erase_if(out, [](const FaultSpan& span) { return span.end_s - span.onset_s < kLeastStay_s; });
  return out;
}

/// Spans of a fault with its size, and how well they explain the log.
struct Spans {
  std::vector<FaultSpan> spans{};
  VectorXd size{};
  double log_likelihood = -std::numeric_limits<double>::infinity();
};

/// Estimates spans and size in turn, from the claim on, with fits of fit_in(). `white`: whitened columns of
/// the fault, present in all rows.
Spans settled_spans(const LogFit& fit, const FaultClaim& claim, const LinearFault& fault,
                    const StackedColumns& white, const FreeForm* change) {
  const int first = std::max(1, fit.first_row(fit.time_s()[0] + kLead_s));
  std::vector<FaultSpan> spans = {{claim.onset_s, claim.end_s}};
  for (int round = 0; round < kRounds; ++round) {
    const SpanFit by = fit_in(fit, fault, spans, change);
    const double price = kEndEvidence * std::max(1.0, by.square);
    std::vector<FaultSpan> next = spans_of(fit, states_of(evidence_of_absence(fit, white, by), first, price));
    if (next.empty()) return {};
    const bool is_settled = next == spans;
    spans = std::move(next);
    if (is_settled) break;
  }
  const Explanation e = explained(fit, fault, spans);
  const double price = kEndEvidence * std::max(1.0, e.mean_square());
  return {spans, e.size, e.log_likelihood - 2.0 * price * static_cast<double>(spans.size())};
}

/// Returns when an encoder that is stuck from `from_s` on gives another code; `from_s` if it is not stuck.
std::optional<double> reads_again_from(const LogFit& fit, int j, double from_s) {
  for (const FaultSpan& run : repeated_codes(fit, j))
    if (run.onset_s <= from_s && run.end_s > from_s)
      return run.end_s < kNeverEnds ? std::optional(run.end_s) : std::nullopt;
  return from_s;
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
  if (claim.kind == FaultKind::locked) return moves_from(fit, claim.joint.index(), from_s);
  if (claim.kind == FaultKind::stuck_encoder) return reads_again_from(fit, claim.joint.index(), from_s);
  if (falsifies_position(claim.kind))
    if (const std::optional<double> back = taken_back_s(sensor_jumps(fit, claim.joint.index()), claim))
      return back;
  return absent_from_s(fit, with_and_without(fit, fault, from_s + kSurelyLasts_s), from_s);
}

}  // namespace

std::vector<FaultClaim> fault_spans(const LogFit& fit, const FaultClaim& claim, const FreeForm& change) {
  const LinearFault* fault = linear_of(fit.linear(), claim);
  if (fault == nullptr || claim.grows) return {};
  const StackedColumns white = fit.whitened(fault->columns.column);
  const Spans own = settled_spans(fit, claim, *fault, white, nullptr),
              early = settled_spans(fit, claim, *fault, white, &change),
              best = early.log_likelihood > own.log_likelihood ? early : own;
  std::vector<FaultClaim> out;
  for (const FaultSpan& span : best.spans) {
    out.push_back(claim);
    out.back().onset_s = span.onset_s;
    out.back().end_s = span.end_s;
    out.back().size = best.size;
  }
  return out;
}

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
  if (std::ranges::all_of(lasting, [](const FaultClaim& claim) { return claim.end_s < kNeverEnds; }))
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
