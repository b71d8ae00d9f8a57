// SPDX-License-Identifier: MIT
#include "lib/explain/fault_spans.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lib/balance/regress.hpp"
#include "lib/explain/fault_end.hpp"
#include "lib/explain/search/white_search.hpp"

namespace faultline {
namespace {

using Eigen::VectorXd;

constexpr int kRounds = 6;  // of spans and size in turn, at most

/// Time in which the fault is present.
struct Span {
  double onset_s = 0.0, end_s = kNeverEnds;

  bool operator==(const Span&) const = default;
};

/// The log explained by a fault that is present in some spans.
struct SpanFit {
  VectorXd size;
  Stacked absent;       ///< whitened residuals without the fault
  double square = 1.0;  ///< mean square of the residuals
};

FaultColumns columns_in(const LogFit& fit, const LinearFault& fault, const std::vector<Span>& spans) {
  FaultColumns out = fault.columns;
  out.column.setZero();
  for (const Span& span : spans) out.column += fit.between(fault.columns, span.onset_s, span.end_s).column;
  return out;
}

Explanation explained(const LogFit& fit, const LinearFault& fault, const std::vector<Span>& spans) {
  return fit.explain_with_piece(fit.residual(), columns_in(fit, fault, spans), fault.starts,
                                spans.front().onset_s);
}

/// Returns the fit with the effects of the day that explain the log best beside the fault.
SpanFit fit_with_day(const LogFit& fit, const LinearFault& fault, const std::vector<Span>& spans) {
  const Explanation e = explained(fit, fault, spans);
  return {e.size, fit.residual_without_fault(e), e.mean_square()};
}

/// Returns the fit with the effects of the day that the rows before the change show.
SpanFit fit_with_day_before(const LogFit& fit, const LinearFault& fault, const std::vector<Span>& spans,
                            const FreeForm& change) {
  const FaultColumns columns = columns_in(fit, fault, spans);
  const Regression sizes =
      regress(normal_equations(fit.whitened(columns.column), change.left), columns.variance.cwiseInverse());
  return {sizes.estimate, change.left, sizes.left / static_cast<double>(change.left.size())};
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

/// Returns by row whether the fault is present: the most likely sequence of states, in which each change
/// costs `price` nats. The fault begins with the row before `first` at the earliest.
std::vector<bool> likely_states(const VectorXd& absence, int first, double price) {
  const Eigen::Index rows = absence.size();
  std::array<double, 2> cost = {0.0, price};  // absent, present
  std::vector<std::array<bool, 2>> has_changed(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const std::array<double, 2> before = cost;
    for (const int state : {0, 1}) {
      const double stays = before[state], changes = before[1 - state] + price;
      has_changed[k][state] = changes < stays;
      cost[state] = std::min(stays, changes);
    }
    cost[0] -= absence[k];
    if (k >= first) continue;
    cost[1] = cost[0] + price;
    has_changed[k][1] = true;
  }
  std::vector<bool> out(rows);
  int state = cost[1] < cost[0] ? 1 : 0;
  for (Eigen::Index k = rows - 1; k >= 0; --k) {
    out[k] = state == 1;
    if (has_changed[k][state]) state = 1 - state;
  }
  return out;
}

/// Returns the spans of the states; times shorter than kLeastStay_s get the state around them.
std::vector<Span> spans_of(const LogFit& fit, const std::vector<bool>& present) {
  std::vector<Span> out;
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
  std::erase_if(out, [](const Span& span) { return span.end_s - span.onset_s < kLeastStay_s; });
  return out;
}

/// Spans of a fault with its size, and how well they explain the log.
struct Spans {
  std::vector<Span> spans{};
  VectorXd size{};
  double log_likelihood = -std::numeric_limits<double>::infinity();
};

/// Estimates spans and size in turn, from the claim on. `white`: whitened columns of the fault, present in
/// all rows. `fit_of` returns the fit of a fault in some spans.
template <typename FitOf>
Spans settled_spans(const LogFit& fit, const FaultClaim& claim, const LinearFault& fault,
                    const StackedColumns& white, const FitOf& fit_of) {
  const int first = std::max(1, fit.first_row(fit.time_s()[0] + kLead_s));
  std::vector<Span> spans = {{claim.onset_s, claim.end_s}};
  for (int round = 0; round < kRounds; ++round) {
    const SpanFit by = fit_of(spans);
    const double price = kEndEvidence * std::max(1.0, by.square);
    std::vector<Span> next = spans_of(fit, likely_states(evidence_of_absence(fit, white, by), first, price));
    if (next.empty()) return {};
    const bool is_settled = next == spans;
    spans = std::move(next);
    if (is_settled) break;
  }
  const Explanation e = explained(fit, fault, spans);
  const double price = kEndEvidence * std::max(1.0, e.mean_square());
  return {spans, e.size, e.log_likelihood - 2.0 * price * static_cast<double>(spans.size())};
}

}  // namespace

std::vector<FaultClaim> fault_spans(const LogFit& fit, const FaultClaim& claim, const FreeForm& change) {
  const LinearFault* fault = linear_of(fit.linear(), claim);
  if (fault == nullptr || claim.grows) return {};
  const auto with_day = [&](const auto& spans) { return fit_with_day(fit, *fault, spans); };
  const auto with_day_before = [&](const auto& spans) {
    return fit_with_day_before(fit, *fault, spans, change);
  };
  const StackedColumns white = fit.whitened(fault->columns.column);
  const Spans own = settled_spans(fit, claim, *fault, white, with_day),
              early = settled_spans(fit, claim, *fault, white, with_day_before),
              best = early.log_likelihood > own.log_likelihood ? early : own;
  std::vector<FaultClaim> out;
  for (const Span& span : best.spans) {
    out.push_back(claim);
    out.back().onset_s = span.onset_s;
    out.back().end_s = span.end_s;
    out.back().size = best.size;
  }
  return out;
}

}  // namespace faultline
