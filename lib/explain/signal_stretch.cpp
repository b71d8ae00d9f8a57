// SPDX-License-Identifier: MIT
#include "lib/explain/signal_stretch.hpp"

#include <algorithm>
#include <optional>

#include "lib/explain/hypothesis_prices.hpp"
#include "lib/explain/judge.hpp"

namespace faultline {
namespace {

constexpr double kAnyForm = 0.5;        // price of any form, as a share of what it alone explains
constexpr double kSensorStays_s = 1.0;  // shortest duration of the offset of a sensor
constexpr double kSensorForm = 0.7;     // share of a difference that an offset of a sensor explains, at least
constexpr double kLongAnswer_s = 1.0;   // a longer stretch of a law after a fault is a response to it
constexpr double kAtOnce_s = 0.1;       // between two onsets, or an end and an onset, that may be one

/// A hypothesis of a stretch.
struct StretchScore {
  FaultClaim claim;
  double gain = 0.0;   ///< nats by which it explains signals and torque balance better than no fault
  double price = 0.0;  ///< nats that it costs

  double score() const { return gain - price; }
};

FaultClaim claim_of(const SignalStretch& stretch, FaultKind kind) {
  return {kind, stretch.joint, stretch.onset_s, stretch.end_s};
}

/// Returns the nats of a hypothesis by the torque balance; 0 without `fit`.
double gain_in_balance(const LogFit* fit, const FaultClaim& claim) {
  if (fit == nullptr) return 0.0;
  const std::optional<FaultHypothesis> judged = judge(*fit, claim);
  return judged ? judged->gain : 0.0;
}

/// Scores a torque of any form: it explains an offset, such as that of a drive, and has a price for all other
/// forms.
StretchScore of_no_kind(const SignalStretch& s, const LogFit* fit) {
  StretchScore out{claim_of(s, FaultKind::unknown)};
  const double moved = std::max(0.0, gain_in_balance(fit, out.claim));
  out.gain = s.nats + moved;
  out.price = kAnyForm * ((1.0 - s.offset_explains) * s.nats + moved);
  return out;
}

bool is_loss(const FaultClaim& claim) { return column_kind(claim.kind) == FaultKind::torque_loss; }

bool may_be_loss(const SignalStretch& s) {
  return s.pair == SignalPair::drive && s.loss > kLeastLoss && s.loss < kMostLoss;
}

/// Scores a loss. The torque balance of the command estimates size and end, too: if the command is too small,
/// or larger than those learned, the signals do not show the end.
StretchScore of_loss(const SignalStretch& s, const LogFit* fit) {
  StretchScore out{claim_of(s, FaultKind::torque_loss)};
  if (s.loss > kFreeShare) out.claim.kind = FaultKind::free_swinging;
  out.claim.size = Eigen::VectorXd::Constant(1, s.loss);
  out.gain = s.loss_explains * s.nats;
  if (fit == nullptr || !s.balance_is_of_command) return out;
  std::optional<FaultHypothesis> best;
  for (const double end_s : {s.end_s, kNeverEnds}) {
    FaultClaim claim = claim_of(s, FaultKind::torque_loss);
    claim.end_s = end_s;
    std::optional<FaultHypothesis> judged = judge(*fit, claim);
    if (judged && (!best || judged->gain > best->gain)) best = std::move(judged);
  }
  if (!best) return out;
  out.gain += best->gain;
  if (best->gain > 0.0) out.claim = *best;
  return out;
}

bool may_be_sensor(const SignalStretch& s) {
  return s.pair == SignalPair::drive && s.offset_explains > kSensorForm &&
         s.end_s - s.onset_s >= kSensorStays_s;
}

/// Scores an offset of the torque sensor, which a torque balance of its measurements shows; empty if it does
/// not.
std::optional<StretchScore> of_sensor(const SignalStretch& s, const LogFit* fit) {
  if (fit == nullptr || s.balance_is_of_command) return std::nullopt;
  const std::optional<FaultHypothesis> judged = judge(*fit, claim_of(s, FaultKind::torque_sensor_error));
  if (!judged || judged->gain <= 0.0) return std::nullopt;
  return StretchScore{*judged, s.offset_explains * s.nats + judged->gain};
}

/// Returns whether a stretch is the response of the controller to a fault: one of a control law that begins
/// after the onset, while the fault lasts, or that is long.
bool answers(const SignalStretch& stretch, const FaultClaim& fault) {
  if (stretch.pair != SignalPair::control_law || fault.onset_s >= stretch.onset_s + kAtOnce_s) return false;
  return answers_earlier_fault(stretch) || fault.end_s >= stretch.onset_s - kAtOnce_s;
}

}  // namespace

ExplainedFault judge_stretch(const SignalStretch& stretch, const LogFit* fit) {
  std::vector<StretchScore> all = {of_no_kind(stretch, fit)};
  if (may_be_loss(stretch)) all.push_back(of_loss(stretch, fit));
  if (may_be_sensor(stretch))
    if (std::optional<StretchScore> sensor = of_sensor(stretch, fit)) all.push_back(std::move(*sensor));
  std::stable_sort(all.begin(), all.end(),
                   [](const StretchScore& a, const StretchScore& b) { return a.score() > b.score(); });
  ExplainedFault out;
  out.claim = all.front().claim;
  out.alarm_s = stretch.alarm_s;
  out.evidence = all.front().gain;
  out.limit = stretch.limit;
  for (const StretchScore& each : all) out.scores.push_back({each.claim, each.score(), 1.0});
  const FaultLabel sensor{FaultKind::torque_sensor_error, stretch.joint};
  for (const StretchScore& each : all)
    if (each.claim.label() != out.label() && each.claim.label() != sensor &&
        each.score() > kAlmostShare * all.front().score())
      out.could_also_be.push_back(each.claim.label());
  if (may_be_sensor(stretch) && out.label() != sensor) out.could_also_be.push_back(sensor);
  return out;
}

std::vector<FaultClaim> balance_claims(const std::vector<JudgedStretch>& stretches) {
  std::vector<FaultClaim> out;
  for (const JudgedStretch& judged : stretches) {
    if (!is_loss(judged.fault.claim) || judged.stretch.balance_is_of_command)
      out.push_back(judged.fault.claim);
  }
  return out;
}

std::vector<JudgedStretch> judged_drives(const std::vector<SignalStretch>& stretches, const LogFit* fit) {
  std::vector<JudgedStretch> out;
  for (const SignalStretch& stretch : stretches)
    if (stretch.pair == SignalPair::drive) out.push_back({stretch, judge_stretch(stretch, fit)});
  return out;
}

std::vector<JudgedStretch> with_laws(std::vector<JudgedStretch> judged,
                                     const std::vector<SignalStretch>& stretches,
                                     const std::vector<FaultClaim>& others, const LogFit* fit) {
  const auto is_answer = [&](const SignalStretch& law) {
    return std::any_of(others.begin(), others.end(),
                       [&](const FaultClaim& claim) { return answers(law, claim); }) ||
           std::any_of(judged.begin(), judged.end(),
                       [&](const JudgedStretch& other) { return answers(law, other.fault.claim); });
  };
  for (const SignalStretch& law : stretches)
    if (law.pair == SignalPair::control_law && !is_answer(law))
      judged.push_back({law, judge_stretch(law, fit)});
  std::stable_sort(judged.begin(), judged.end(), [](const JudgedStretch& a, const JudgedStretch& b) {
    return a.stretch.onset_s < b.stretch.onset_s;
  });
  return judged;
}

bool begins_within_law(const std::vector<JudgedStretch>& stretches, const FaultClaim& fault) {
  return std::any_of(stretches.begin(), stretches.end(), [&](const JudgedStretch& judged) {
    const SignalStretch& law = judged.stretch;
    return law.pair == SignalPair::control_law && fault.onset_s > law.onset_s - kAtOnce_s &&
           fault.onset_s < law.end_s + kAtOnce_s;
  });
}

bool answers_earlier_fault(const SignalStretch& stretch) {
  return stretch.pair == SignalPair::control_law && stretch.end_s - stretch.onset_s >= kLongAnswer_s;
}

}  // namespace faultline
