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

/// Returns the nats of a systematic form error of the known faults in the rows of a further one: what their
/// columns lack (form_shares()) may have the sign of its effect in each of them, while the noise of the rows
/// takes it for independent.
double form_error_of_known(const LogFit& fit, const FaultClaim& further) {
  const LinearFault* linear = linear_of(fit.linear(), further);
  double out = 0.0;
  for (const FaultClaim& known : fit.known()) {
    if (known.size.size() == 0 || falsifies_position(known.kind)) continue;
    const VectorXd share = form_shares(fit.rows(), fit.model().setting, known);
    const MatrixXd torque = unstacked(columns_of(fit, known).column * known.size, fit.joints());
    const MatrixXd error =
        unstacked(fit.whitened(stacked(torque.array().colwise() * share.array())), fit.joints());
    for (int j = 0; j < fit.joints(); ++j) {
      if (linear && linear->columns.column.middleRows(j * fit.count(), fit.count()).isZero(0.0)) continue;
      for (int k = fit.first_row(further.onset_s); k < fit.first_row(further.end_s); ++k)
        if (!std::isnan(error(k, j))) out += 0.5 * Eigen::numext::abs2(error(k, j));
    }
  }
  return out;
}

}  // namespace

std::vector<ExplainedFault> further_faults(const LogFit& fit, const LogExplanation& e,
                                           const EvidenceLimits& limits, std::size_t most) {
  std::vector<ExplainedFault> out = named_faults(e, scaled(limits, residual_of_known(fit)), most);
  std::erase_if(out, [&](const ExplainedFault& fault) {
    return is_too_weak(fault, limits, fit) ||
           fault.evidence <= limits.of(fault.claim.kind) + form_error_of_known(fit, fault.claim) ||
           std::ranges::any_of(fit.known(),
                               [&](const FaultClaim& known) { return begin_as_one(known, fault.claim); });
  });
  return out;
}

}  // namespace faultline
