// SPDX-License-Identifier: MIT
#include "lib/explain/decide_log.hpp"

#include <algorithm>

namespace faultline {
namespace {

constexpr double kBeyondHealthy = 3.0;   // times the evidence of healthy logs
constexpr double kNearlyAll = 0.05;      // share of the excess over the noise that a lock leaves, at most
constexpr double kAlmost = 5.0;          // nats over the mean square of residuals: as good as the best
constexpr std::size_t kTraced = 4;       // hypotheses whose evidence is traced
constexpr double kTracedBeyond_s = 1.0;  // s beyond the alarm, up to which it is traced

/// Returns whether a hypothesis has a size that may be a fault.
bool may_be_fault(const FaultHypothesis& h) {
  return h.kind != FaultKind::torque_loss || !(h.size[0] < kLeastLoss);
}

bool passes(const FaultHypothesis& h, const EvidenceLimits& limits) {
  return may_be_fault(h) && h.gain > limits.of(h.kind);
}

/// Returns the limit of the free form, nats.
double limit_of_free_form(const EvidenceLimits& limits) {
  return std::max(kOfNoKind, limits.of(FaultKind::unknown));
}

std::vector<LabelScore> scores_of(const LogExplanation& e) {
  std::vector<LabelScore> out;
  for (const FaultHypothesis& h : e.best) out.push_back({h, h.gain, h.fit.mean_square()});
  return out;
}

/// Returns the evidence over time of a fault, which is `course`, and of the hypotheses that come next to it.
EvidenceTrace trace_of(const LogExplanation& e, const FaultLabel& fault, const EvidenceCourse& course,
                       double until_s) {
  std::vector<FaultLabel> labels = {fault};
  std::vector<EvidenceCourse> courses = {course};
  for (const FaultHypothesis& h : e.best) {
    if (courses.size() == kTraced) break;
    if (h.kind == FaultKind::unknown || h.label() == fault) continue;
    labels.push_back(h.label());
    courses.push_back(h.course);
  }
  return faultline::trace_of(labels, courses, until_s);
}

}  // namespace

EvidenceLimits evidence_limits(const std::vector<LogExplanation>& healthy) {
  EvidenceLimits out;
  double most = kLeastEvidence, most_of_a_push = kLeastEvidence;
  double& unknown = out.nats[static_cast<std::size_t>(FaultKind::unknown)];
  for (const LogExplanation& e : healthy) {
    unknown = std::max(unknown, kBeyondHealthy * e.free_gain);
    most_of_a_push = std::max(most_of_a_push, e.most_of_a_push);
    for (const FaultHypothesis& h : e.best) {
      double& nats = out.nats[static_cast<std::size_t>(h.kind)];
      nats = std::max(nats, kBeyondHealthy * h.gain);
      most = std::max(most, h.gain);
    }
  }
  for (std::size_t kind = 0; kind < out.nats.size(); ++kind)
    out.nats[kind] = std::max(out.nats[kind],
                              static_cast<FaultKind>(kind) == FaultKind::collision ? most_of_a_push : most);
  return out;
}

double least_limit(const EvidenceLimits& limits) { return *std::ranges::min_element(limits.nats); }

EvidenceScore score_of(const LogExplanation& e, const EvidenceLimits& limits) {
  EvidenceScore out;
  const auto add = [&](const FaultClaim& claim, double nats, double limit) {
    out = larger(out, {claim.label(), claim.onset_s, std::max(0.0, nats), limit});
  };
  for (const std::vector<FaultHypothesis>* judged : {&e.best, &e.quiet})
    for (const FaultHypothesis& h : *judged)
      if (may_be_fault(h)) add(h, h.gain, limits.of(h.kind));
  if (!e.free_course.time_s.empty() || e.best.empty())
    add({.kind = FaultKind::unknown, .onset_s = e.free_form.onset_s}, e.free_gain,
        limit_of_free_form(limits));
  return out;
}

EvidenceScore score_of(const ExplainedFault& fault) {
  return {fault.label(), fault.claim.onset_s, fault.evidence, fault.limit};
}

std::vector<ExplainedFault> named_faults(const LogExplanation& e, const EvidenceLimits& limits,
                                         std::size_t most) {
  std::vector<ExplainedFault> out;
  for (auto best = e.best.begin(); best != e.best.end() && out.size() < most; ++best) {
    if (!passes(*best, limits)) continue;
    ExplainedFault& fault = out.emplace_back();
    fault.claim = *best;
    fault.evidence = best->gain;
    fault.misfit = best->misfit;
    fault.shrinking = best->shrinking;
    const double left = best->fit.mean_square(), scale = std::max(1.0, left);
    fault.residual_share = std::max(0.0, left - 1.0) / std::max(1.0, e.healthy_square - 1.0);
    for (auto h = best + 1; h != e.best.end(); ++h)
      if ((best->gain - h->gain) / scale < kAlmost || h->gain > kAlmostShare * best->gain)
        fault.could_also_be.push_back(h->label());
    fault.limit = limits.of(best->kind);
    fault.alarm_s = best->course.alarm_s(fault.limit);
    fault.scores = scores_of(e);
    fault.trace = trace_of(e, best->label(), best->course, fault.alarm_s + kTracedBeyond_s);
    fault.trace.limit = fault.limit;
  }
  return out;
}

ExplainedFault as_unknown(const ExplainedFault& named, const LogExplanation& e) {
  ExplainedFault out = named;
  out.claim.kind = FaultKind::unknown;
  out.claim.size = {};
  out.could_also_be.insert(out.could_also_be.begin(), named.label());
  if (e.free_course.time_s.empty()) return out;
  out.claim.onset_s = e.free_form.onset_s;
  out.claim.end_s = e.free_form.end_s;
  out.alarm_s = e.free_course.alarm_s(named.limit);
  return out;
}

std::optional<ExplainedFault> unnamed_fault(const LogExplanation& e, const EvidenceLimits& limits) {
  const double limit = limit_of_free_form(limits);
  if (e.best.empty() || e.free_gain <= limit) return std::nullopt;
  const FaultHypothesis& nearest = e.best.front();
  ExplainedFault named;
  named.claim = nearest;
  named.evidence = e.free_gain;
  named.limit = limit;
  named.misfit = nearest.misfit;
  named.scores = scores_of(e);
  ExplainedFault out = as_unknown(named, e);
  out.trace = trace_of(e, out.label(), e.free_course, out.alarm_s + kTracedBeyond_s);
  out.trace.limit = limit;
  return out;
}

EvidenceLimits scaled(EvidenceLimits limits, double factor) {
  for (double& nats : limits.nats) nats *= factor;
  return limits;
}

EvidenceLimits above_false_alarm(EvidenceLimits limits, const ExplainedFault& fault) {
  double& own = limits.nats[static_cast<std::size_t>(fault.claim.kind)];
  own = std::max(own, kBeyondSimulated * fault.evidence);
  for (const LabelScore& score : fault.scores) {
    double& nats = limits.nats[static_cast<std::size_t>(score.claim.kind)];
    nats = std::max(nats, kBeyondSimulated * score.nats);
  }
  return limits;
}

bool has_large_misfit(const ExplainedFault& named) {
  return named.claim.kind != FaultKind::stuck_encoder && named.misfit > kOfNoKind;
}

bool suffices(const ExplainedFault& named) {
  return !has_large_misfit(named) ||
         (named.claim.kind == FaultKind::locked && named.residual_share < kNearlyAll);
}

std::optional<ExplainedFault> decide_log(const LogExplanation& e, const EvidenceLimits& limits) {
  const std::vector<ExplainedFault> named = named_faults(e, limits, 1);
  if (named.empty()) return unnamed_fault(e, limits);
  if (suffices(named.front())) return named.front();
  return as_unknown(named.front(), e);
}

}  // namespace faultline
