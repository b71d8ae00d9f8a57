// SPDX-License-Identifier: MIT
#include "lib/explain/decide_log.hpp"

#include <algorithm>

namespace faultline {
namespace {

constexpr double kBeyondHealthy = 2.0;  // times the evidence of healthy logs
constexpr double kLeastLoss = 0.08;     // share of the torque: less is the gain of another day
constexpr double kAlmost = 5.0;         // nats, in units of the mean square left: as good as the best
constexpr double kAlmostShare = 0.95;   // of the best evidence

bool passes(const FaultHypothesis& h, const EvidenceLimits& limits) {
  if (h.kind == FaultKind::torque_loss && h.size[0] < kLeastLoss) return false;
  return h.gain > limits.of(h.kind);
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

std::vector<ExplainedFault> named_faults(const LogExplanation& e, const EvidenceLimits& limits,
                                         const AlarmTimes& alarms, std::size_t most) {
  std::vector<ExplainedFault> out;
  for (auto best = e.best.begin(); best != e.best.end() && out.size() < most; ++best) {
    if (!passes(*best, limits)) continue;
    ExplainedFault& fault = out.emplace_back();
    fault.claim = *best;
    fault.evidence = best->gain;
    fault.left = best->fit.mean_square();
    const double scale = std::max(1.0, fault.left);
    for (auto h = best + 1; h != e.best.end(); ++h)
      if ((best->gain - h->gain) / scale < kAlmost || h->gain > kAlmostShare * best->gain)
        fault.could_also_be.push_back({h->kind, h->joint});
    fault.alarm_s = alarms.of(*best, limits.of(best->kind));
  }
  return out;
}

ExplainedFault as_unknown(const ExplainedFault& named, const LogExplanation& e, const EvidenceLimits& limits,
                          const AlarmTimes& alarms) {
  ExplainedFault out = named;
  out.claim.kind = FaultKind::unknown;
  out.claim.size = {};
  out.could_also_be.insert(out.could_also_be.begin(), named.label());
  if (!alarms.of_free_form) return out;
  out.claim.onset_s = e.free_form.onset_s;
  out.claim.end_s = e.free_form.end_s;
  out.alarm_s = alarms.of_free_form(limits.of(named.claim.kind));
  return out;
}

EvidenceLimits scaled(EvidenceLimits limits, double factor) {
  for (double& nats : limits.nats) nats *= factor;
  return limits;
}

bool leaves_much(const ExplainedFault& named, double without) {
  if (named.claim.kind == FaultKind::stuck_encoder) return false;
  return named.left > kMuchLeft && named.left - 1.0 > kUnexplained * (without - 1.0);
}

std::optional<ExplainedFault> decide_log(const LogExplanation& e, const EvidenceLimits& limits,
                                         const AlarmTimes& alarms) {
  const std::vector<ExplainedFault> named = named_faults(e, limits, alarms, 1);
  if (named.empty()) return std::nullopt;
  if (!leaves_much(named.front(), e.healthy_square)) return named.front();
  return as_unknown(named.front(), e, limits, alarms);
}

}  // namespace faultline
