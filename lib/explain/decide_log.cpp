// SPDX-License-Identifier: MIT
#include "lib/explain/decide_log.hpp"

#include <algorithm>

namespace faultline {
namespace {

constexpr double kBeyondHealthy = 3.0;  // times the evidence of healthy logs
constexpr double kLeastLoss = 0.08;     // share of the torque: less is the gain of another day
constexpr double kOfNoKind = 200.0;     // nats by which a change of any form explains more
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

LogEvidence log_evidence(const LogFit& fit, const LogExplanation& e) {
  return {[&fit](const FaultHypothesis& h, double limit) { return alarm_time(fit, h, limit); },
          [&fit, &e](const FaultHypothesis& h) { return misfit(fit, e.free_form, h); },
          [&fit, &e](double limit) { return alarm_time(fit, e.free_form, limit); }};
}

std::vector<ExplainedFault> named_faults(const LogExplanation& e, const EvidenceLimits& limits,
                                         const LogEvidence& evidence, std::size_t most) {
  std::vector<ExplainedFault> out;
  for (auto best = e.best.begin(); best != e.best.end() && out.size() < most; ++best) {
    if (!passes(*best, limits)) continue;
    ExplainedFault& fault = out.emplace_back();
    fault.claim = *best;
    fault.evidence = best->gain;
    fault.misfit = evidence.misfit(*best);
    const double scale = std::max(1.0, best->fit.mean_square());
    for (auto h = best + 1; h != e.best.end(); ++h)
      if ((best->gain - h->gain) / scale < kAlmost || h->gain > kAlmostShare * best->gain)
        fault.could_also_be.push_back({h->kind, h->joint});
    fault.alarm_s = evidence.alarm(*best, limits.of(best->kind));
  }
  return out;
}

ExplainedFault as_unknown(const ExplainedFault& named, const LogExplanation& e, const EvidenceLimits& limits,
                          const LogEvidence& evidence) {
  ExplainedFault out = named;
  out.claim.kind = FaultKind::unknown;
  out.claim.size = {};
  out.could_also_be.insert(out.could_also_be.begin(), named.label());
  if (!evidence.alarm_of_free_form) return out;
  out.claim.onset_s = e.free_form.onset_s;
  out.claim.end_s = e.free_form.end_s;
  out.alarm_s = evidence.alarm_of_free_form(limits.of(named.claim.kind));
  return out;
}

EvidenceLimits scaled(EvidenceLimits limits, double factor) {
  for (double& nats : limits.nats) nats *= factor;
  return limits;
}

bool leaves_much(const ExplainedFault& named) {
  return named.claim.kind != FaultKind::stuck_encoder && named.misfit > kOfNoKind;
}

std::optional<ExplainedFault> decide_log(const LogExplanation& e, const EvidenceLimits& limits,
                                         const LogEvidence& evidence) {
  const std::vector<ExplainedFault> named = named_faults(e, limits, evidence, 1);
  if (named.empty()) return std::nullopt;
  if (!leaves_much(named.front())) return named.front();
  return as_unknown(named.front(), e, limits, evidence);
}

}  // namespace faultline
