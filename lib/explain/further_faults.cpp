// SPDX-License-Identifier: MIT
#include "lib/explain/further_faults.hpp"

#include <algorithm>
#include <cmath>

#include "lib/explain/fault_columns.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Returns whether two faults of a joint begin so close together that the second is a form error of the
/// first.
bool begin_as_one(const FaultClaim& a, const FaultClaim& b) {
  return a.joint == b.joint && std::abs(a.onset_s - b.onset_s) < kAsOne_s;
}

/// Returns the mean square that known faults leave in the first second of each, at most that of the whole
/// log: evidence is counted in units of it, if it is larger than the noise. Later rows may hold a further
/// fault.
double residual_of_known(const LogFit& fit) {
  double out = 1.0;
  for (FaultClaim claim : fit.known()) {
    claim.onset_s = std::max(claim.onset_s, fit.log().start_s);
    claim.end_s = std::min(claim.end_s, claim.onset_s + kAsOne_s);
    const ResidualWithin left = residual_within(fit, claim, fit.healthy());
    if (const double rows = left.rows.sum(); rows > 0.0)
      out = std::max(out, left.rows.dot(left.square) / rows);
  }
  return std::min(out, std::max(1.0, fit.healthy().mean_square()));
}

/// Returns whether a fault that begins before all known faults is too weak: the rows before those were taken
/// for healthy, and its evidence is counted in units of what is left of the whole log.
bool is_too_weak(const ExplainedFault& fault, const EvidenceLimits& limits, const LogFit& fit) {
  const std::vector<FaultClaim>& known = fit.known();
  const bool is_first = std::ranges::all_of(
      known, [&](const FaultClaim& claim) { return fault.claim.onset_s < claim.onset_s; });
  const double left = known.empty() ? 1.0 : std::max(1.0, fit.healthy().mean_square());
  return is_first && fault.evidence <= left * limits.of(fault.claim.kind);
}

/// Returns the nats of a systematic form error of the known faults, by row (rows x joints): what their
/// columns lack may have the sign of a further fault's effect in each row, while the noise takes it for
/// independent.
MatrixXd form_errors_of_known(const LogFit& fit) {
  MatrixXd out = MatrixXd::Zero(fit.count(), fit.joints());
  for (const Stacked& error : fit.form_errors()) {
    const MatrixXd white = unstacked(fit.whitened(error), fit.joints());
    out += white.array().isNaN().select(0.0, 0.5 * white.array().square()).matrix();
  }
  return out;
}

/// Returns the sum of these nats over the rows of a fault, at the joints on which it acts.
double sum_within(const MatrixXd& nats, const LogFit& fit, const FaultClaim& claim) {
  const LinearFault* linear = linear_of(fit.linear(), claim);
  const int first = fit.first_row(claim.onset_s), last = fit.first_row(claim.end_s);
  double out = 0.0;
  for (int j = 0; j < fit.joints(); ++j)
    if (!linear || !linear->columns.column.middleRows(j * fit.count(), fit.count()).isZero(0.0))
      out += nats.col(j).segment(first, last - first).sum();
  return out;
}

}  // namespace

std::vector<ExplainedFault> further_faults(const LogFit& fit, const LogExplanation& e,
                                           const EvidenceLimits& limits, std::size_t most) {
  std::vector<ExplainedFault> out = named_faults(e, scaled(limits, residual_of_known(fit)), most);
  if (out.empty()) return out;
  const MatrixXd form_errors = form_errors_of_known(fit);
  std::erase_if(out, [&](const ExplainedFault& fault) {
    return is_too_weak(fault, limits, fit) ||
           fault.evidence <= limits.of(fault.claim.kind) + sum_within(form_errors, fit, fault.claim) ||
           std::ranges::any_of(fit.known(),
                               [&](const FaultClaim& known) { return begin_as_one(known, fault.claim); });
  });
  return out;
}

}  // namespace faultline
