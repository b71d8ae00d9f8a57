// SPDX-License-Identifier: MIT
#include "lib/explain/decide_log.hpp"

#include <algorithm>

namespace faultline {
namespace {

constexpr double kBeyondHealthy = 2.0;  // times the evidence of healthy logs
constexpr double kLeastLoss = 0.08;     // share of the torque: less is the gain of another day
constexpr double kUnexplained = 0.3;    // share of what the healthy robot leaves, and
constexpr double kMuchLeft = 3.0;       // mean square from which the best explanation is none
constexpr double kAlmost = 5.0;         // nats, in units of the mean square left: as good as the best
constexpr double kAlmostShare = 0.95;   // of the best evidence

bool passes(const FaultHypothesis& h, const EvidenceLimits& limits) {
  if (h.kind == FaultKind::torque_loss && h.size[0] < kLeastLoss) return false;
  return h.gain > limits.of(h.kind);
}

/// Whether the best explanation leaves so much that the fault is none of the kinds.
bool is_unknown(const FaultHypothesis& best, const LogExplanation& e) {
  if (e.slips && best.kind == FaultKind::sensor_bias) return true;
  if (best.kind == FaultKind::stuck_encoder) return false;
  const double left = best.fit.mean_square();
  return left > kMuchLeft && left - 1.0 > kUnexplained * (e.healthy_square - 1.0);
}

}  // namespace

EvidenceLimits evidence_limits(const std::vector<LogExplanation>& healthy) {
  EvidenceLimits out;
  double most = kLeastEvidence;
  for (const LogExplanation& e : healthy)
    for (const FaultHypothesis& h : e.best) {
      double& nats = out.nats[static_cast<std::size_t>(h.kind)];
      nats = std::max(nats, kBeyondHealthy * h.gain);
      most = std::max(most, h.gain);
    }
  for (double& nats : out.nats) nats = std::max(nats, most);
  return out;
}

AlarmTimes alarm_times(const LogFit& fit, const LogExplanation& e) {
  return {[&fit](const FaultHypothesis& h, double limit) { return alarm_time(fit, h, limit); },
          [&fit, &e](double limit) { return alarm_time(fit, e.free_form, limit); }};
}

std::optional<ExplainedFault> decide_log(const LogExplanation& e, const EvidenceLimits& limits,
                                         const AlarmTimes& alarms) {
  const auto best =
      std::find_if(e.best.begin(), e.best.end(), [&](const FaultHypothesis& h) { return passes(h, limits); });
  if (best == e.best.end()) return std::nullopt;
  ExplainedFault out;
  out.evidence = best->gain;
  out.size = best->size;
  const double scale = std::max(1.0, best->fit.mean_square());
  const bool unknown = is_unknown(*best, e);
  if (unknown) out.could_also_be.push_back({best->kind, best->joint});
  for (auto h = best + 1; h != e.best.end(); ++h)
    if ((best->gain - h->gain) / scale < kAlmost || h->gain > kAlmostShare * best->gain)
      out.could_also_be.push_back({h->kind, h->joint});
  const double limit = limits.of(best->kind);
  const bool any_form = unknown && alarms.of_free_form && !(e.slips && best->kind == FaultKind::sensor_bias);
  out.label = unknown ? FaultLabel{FaultKind::unknown, best->joint} : FaultLabel{best->kind, best->joint};
  out.onset_s = any_form ? e.free_form.onset_s : best->onset_s;
  out.alarm_s = any_form ? alarms.of_free_form(limit) : alarms.of(*best, limit);
  return out;
}

}  // namespace faultline
