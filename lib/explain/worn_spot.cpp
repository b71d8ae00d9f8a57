// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/balance/smoothing.hpp"
#include "lib/core/golden_section.hpp"
#include "lib/explain/explain_faults.hpp"

namespace faultline {
namespace {

constexpr double kPriceOfNumber = 6.0;  // nats of an onset, an end or an edge of a range: ln(20 s / .05 s)
// Share of the evidence of three or more visits that a worn spot needs: its friction is not exact near rest.
// Separate faults leave it far less, since the joint visits their positions at other times, too. Two faults
// may share a range by chance, so that the spot must explain them better.
constexpr double kAsGood = 0.9;
constexpr std::size_t kByChance = 2;     // visits that may share a range by chance
constexpr double kEdgeSearched = 0.15;   // share of the range within which each of its edges is searched
constexpr int kEdgeRounds = 7;           // of the golden section
constexpr double kLeastOutside = 0.1;    // share of the rows since the onset that lie outside a worn spot
constexpr double kLeastVelocity = 1e-9;  // rad/s or m/s: keeps the kernel's length in positions above zero

/// A range of positions of a joint, rad or m.
struct PositionRange {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

/// Whether a fault may be a visit of the joint to a worn spot: a torque of it that comes or goes.
bool may_be_visit(const FaultClaim& claim, Joint joint) {
  const bool is_torque = claim.kind == FaultKind::friction_increase || claim.kind == FaultKind::collision ||
                         claim.kind == FaultKind::torque_sensor_error;
  return claim.joint == joint && is_torque && !claim.grows;
}

/// Returns the positions of the joint during the visits.
PositionRange range_of(const LogFit& fit, const std::vector<FaultClaim>& visits, int j) {
  PositionRange out;
  for (const FaultClaim& visit : visits)
    for (int k = 0; k < fit.count(); ++k) {
      if (fit.time_s()[k] < visit.onset_s || fit.time_s()[k] > visit.end_s) continue;
      out.low = std::min(out.low, fit.rows().q(k, j));
      out.high = std::max(out.high, fit.rows().q(k, j));
    }
  return out;
}

/// Returns by row 1 if the joint (from 0) is in the range, else 0, smoothed as the rows are.
Eigen::VectorXd presence(const LogFit& fit, const PositionRange& range, int j) {
  Eigen::VectorXd out(fit.count());
  for (int k = 0; k < fit.count(); ++k) {
    const double q = fit.rows().q(k, j);
    const double width =
        std::max(std::abs(fit.rows().dq(k, j)), kLeastVelocity) * fit.model().setting.kernel_s;
    out[k] = normal_cdf((q - range.low) / width) - normal_cdf((q - range.high) / width);
  }
  return out;
}

/// Returns the nats by which more friction in the range, from an onset on, explains the log.
double gain_in(const LogFit& fit, const LinearFault& friction, const PositionRange& range, double onset_s) {
  FaultColumns columns = fit.between(friction.columns, onset_s, kNeverEnds);
  const int j = friction.joint.index(), rows = fit.count();
  columns.column.middleRows(j * rows, rows).array().colwise() *= presence(fit, range, j).array();
  return fit.explain(fit.residual(), columns, fit.healthy().path).log_likelihood -
         fit.healthy().log_likelihood;
}

/// Returns whether the joint (from 0) is outside the range in enough rows since the onset: else friction
/// without a range explains them as well.
bool leaves(const LogFit& fit, const PositionRange& range, double onset_s, int j) {
  int outside = 0, all = 0;
  for (int k = fit.first_row(onset_s); k < fit.count(); ++k, ++all)
    outside += fit.rows().q(k, j) < range.low || fit.rows().q(k, j) > range.high;
  return outside > kLeastOutside * all;
}

/// Returns the nats by which a worn spot explains the log, with the best range near the positions of the
/// visits.
double gain_of_spot(const LogFit& fit, const std::vector<FaultClaim>& visits, Joint joint) {
  const LinearFault* friction = linear_of(fit.linear(), {FaultKind::friction_increase, joint});
  const double onset_s = visits.front().onset_s;
  PositionRange range = range_of(fit, visits, joint.index());
  if (friction == nullptr || !(range.low < range.high) || !leaves(fit, range, onset_s, joint.index()))
    return -std::numeric_limits<double>::infinity();
  const double search = kEdgeSearched * (range.high - range.low);
  for (double* edge : {&range.low, &range.high})
    *edge = golden_section(*edge - search, *edge + search, kEdgeRounds, [&](double at) {
      PositionRange tried = range;
      (edge == &range.low ? tried.low : tried.high) = at;
      return -gain_in(fit, *friction, tried, onset_s);
    });
  return gain_in(fit, *friction, range, onset_s) - 3.0 * kPriceOfNumber;
}

/// Returns the nats by which the visits as faults of their own explain the log.
double gain_of_visits(const LogFit& together, const LogFit& without, const std::vector<FaultClaim>& visits) {
  return together.healthy().log_likelihood - without.healthy().log_likelihood -
         2.0 * kPriceOfNumber * static_cast<double>(visits.size());
}

/// Replaces the visits among the faults by one fault of no known kind that lasts from the first on.
std::vector<ExplainedFault> with_one_spot(std::vector<ExplainedFault> faults, Joint joint) {
  const auto is_visit = [&](const ExplainedFault& fault) { return may_be_visit(fault.claim, joint); };
  const auto first = std::ranges::find_if(faults, is_visit);
  first->could_also_be.insert(first->could_also_be.begin(), first->label());
  first->claim = {FaultKind::unknown, joint, first->claim.onset_s, kNeverEnds};
  faults.erase(std::remove_if(first + 1, faults.end(), is_visit), faults.end());
  return faults;
}

}  // namespace

std::vector<ExplainedFault> without_worn_spots(const UniformLog& log, const BalanceModel& model,
                                               const std::vector<FaultClaim>& before,
                                               std::vector<ExplainedFault> faults) {
  for (int j = 0; j < model.joints(); ++j) {
    const Joint joint = Joint::at(j);
    std::vector<FaultClaim> visits, others = before;
    for (const ExplainedFault& fault : faults)
      (may_be_visit(fault.claim, joint) ? visits : others).push_back(fault.claim);
    if (visits.size() < 2) continue;
    std::vector<FaultClaim> all = others;
    all.insert(all.end(), visits.begin(), visits.end());
    const RowNoise noise = LogFit(log, model, all).noise();
    const LogFit together(log, model, all, noise), without(log, model, others, noise);
    const double share = visits.size() > kByChance ? kAsGood : 1.0;
    if (gain_of_spot(without, visits, joint) > share * gain_of_visits(together, without, visits))
      faults = with_one_spot(std::move(faults), joint);
  }
  return faults;
}

}  // namespace faultline
