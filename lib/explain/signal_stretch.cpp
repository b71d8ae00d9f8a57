// SPDX-License-Identifier: MIT
#include "lib/explain/signal_stretch.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/explain/judge/judge.hpp"
#include "lib/explain/refine.hpp"

namespace faultline {
namespace {

constexpr double kAnyForm = 0.5;        // price of any form, as a share of what it alone explains
constexpr double kSensorStays_s = 1.0;  // shortest duration of an error of a sensor
constexpr double kDetermined =
    8.0;  // standard deviations in the torque balance: a difference that it determines
constexpr double kSmallPart =
    0.25;  // of the difference: less in the torque balance means that the sensor is wrong
constexpr double kLongAnswer_s = 1.0;    // a longer stretch of a law after a fault is a response to it
constexpr double kAlikeLosses = 0.7;     // least ratio of two shares that may be one loss
constexpr double kQuietCommand_s = 1.0;  // between two stretches of one loss, if no torque balance shows it
constexpr double kNear_s = 0.3;          // between times by the signals and by the torque balance
constexpr double kAtOnce_s = 0.1;        // between two onsets, or an end and an onset, that may be one

/// A hypothesis of a stretch.
struct StretchScore {
  FaultClaim claim;
  double gain = 0.0;        ///< nats by which it explains signals and torque balance better than no fault
  double price = 0.0;       ///< nats that it costs
  double in_balance = 0.0;  ///< part of `gain` by the torque balance

  double score() const { return gain - price; }
};

FaultClaim claim_of(const SignalStretch& stretch, FaultKind kind) {
  return {kind, stretch.joint, stretch.onset_s, stretch.end_s};
}

/// Returns the nats of a hypothesis by the torque balance; 0 without `fit`, or if it shows nothing of it.
double gain_in_balance(const LogFit* fit, const FaultClaim& claim) {
  if (fit == nullptr) return 0.0;
  const std::optional<FaultHypothesis> judged = judge(*fit, claim);
  return judged ? std::max(0.0, judged->gain) : 0.0;
}

bool may_be_sensor(const SignalStretch& s) {
  return s.pair == SignalPair::drive && s.end_s - s.onset_s >= kSensorStays_s;
}

/// Returns whether the motion shows that the drive gave what was commanded, so that the sensor is wrong: the
/// torque balance of the command determines the difference, and finds a small part of it at most.
bool motion_fits_command(const SignalStretch& s, const LogFit* fit) {
  if (!may_be_sensor(s) || !s.balance_is_of_command || fit == nullptr) return false;
  const bool is_share = s.loss_explains > s.offset_explains;
  const double claimed = std::abs(is_share ? s.loss : s.offset);
  const std::optional<FaultHypothesis> judged =
      judge(*fit, claim_of(s, is_share ? FaultKind::torque_loss : FaultKind::torque_sensor_error));
  if (!judged || judged->fit.size.size() != 1) return false;
  return claimed > kDetermined * std::sqrt(judged->fit.size_covariance(0, 0)) &&
         std::abs(judged->fit.size[0]) < kSmallPart * claimed;
}

/// Scores a torque of any form: it explains an offset, such as that of a drive, and has a price for all other
/// forms. A torque balance of the command lacks the torque that the drive did not give; one of a sensor shows
/// its error.
StretchScore score_free_form(const SignalStretch& s, const LogFit* fit) {
  StretchScore out{claim_of(s, FaultKind::unknown)};
  out.claim.is_of_drive = true;
  double offset = 0.0;
  if (s.pair == SignalPair::drive) {
    if (s.balance_is_of_command) offset = gain_in_balance(fit, claim_of(s, FaultKind::torque_sensor_error));
    out.in_balance = std::max(offset, gain_in_balance(fit, out.claim));
  }
  out.gain = s.nats + out.in_balance;
  const double as_offset = motion_fits_command(s, fit) ? 0.0 : s.offset_explains;
  out.price = kAnyForm * ((1.0 - as_offset) * s.nats + out.in_balance - offset);
  return out;
}

bool is_loss(const FaultClaim& claim) { return column_kind(claim.kind) == FaultKind::torque_loss; }

/// Judges a loss whose onset and end are near those of a claim, where the torque balance explains most; empty
/// if it cannot judge it.
std::optional<FaultHypothesis> best_times(const LogFit& fit, const FaultClaim& claim) {
  JudgedHypotheses bench{fit};
  const std::optional<FaultHypothesis> first = bench.go(claim);
  if (!first) return std::nullopt;
  refine(*first, bench);
  std::optional<FaultHypothesis> out;
  for (const FaultHypothesis& each : bench.judged) {
    const bool is_near = std::abs(each.onset_s - claim.onset_s) < kNear_s &&
                         (each.end_s == claim.end_s || std::abs(each.end_s - claim.end_s) < kNear_s);
    if (is_near && (!out || each.gain > out->gain)) out = each;
  }
  return out;
}

/// Scores a share of the command that the drive does not give. Empty if the signals do not show one, or if
/// the torque balance of the command contradicts it: then the sensor is wrong, not the drive.
std::optional<StretchScore> of_loss(const SignalStretch& s, const LogFit* fit) {
  if (s.pair != SignalPair::drive || s.loss < kLeastLoss || s.loss > kMostLoss) return std::nullopt;
  StretchScore out{claim_of(s, FaultKind::torque_loss)};
  if (s.balance_is_of_command && fit != nullptr) {
    const std::optional<FaultHypothesis> best = best_times(*fit, out.claim);
    if (!best || best->gain <= 0.0) return std::nullopt;
    out.claim = *best;
    out.in_balance = best->gain;
  } else {
    if (s.loss > kFreeShare) out.claim.kind = FaultKind::free_swinging;
    out.claim.size = Eigen::VectorXd::Constant(1, s.loss);
  }
  out.gain = s.loss_explains * s.nats + out.in_balance;
  return out;
}

/// Scores an error of the torque sensor: one that the motion proves, since it fits the command, or an offset
/// that a torque balance of its measurements shows; empty if neither does.
std::optional<StretchScore> of_sensor(const SignalStretch& s, const LogFit* fit) {
  if (motion_fits_command(s, fit)) {
    StretchScore out{claim_of(s, FaultKind::torque_sensor_error),
                     std::max(s.offset_explains, s.loss_explains) * s.nats};
    out.claim.size = Eigen::VectorXd::Constant(1, s.offset);
    return out;
  }
  if (!may_be_sensor(s) || fit == nullptr || s.balance_is_of_command) return std::nullopt;
  const std::optional<FaultHypothesis> judged = judge(*fit, claim_of(s, FaultKind::torque_sensor_error));
  if (!judged || judged->gain <= 0.0) return std::nullopt;
  return StretchScore{*judged, s.offset_explains * s.nats + judged->gain, 0.0, judged->gain};
}

/// Returns whether a stretch is the response of the controller to a fault: one of a control law that begins
/// after the onset, while the fault lasts, or that is long.
bool is_response(const SignalStretch& law, const FaultClaim& fault) {
  if (fault.onset_s >= law.onset_s + kAtOnce_s) return false;
  return answers_earlier_fault(law) || fault.end_s >= law.onset_s - kAtOnce_s;
}

/// Returns whether a fault of the torque balance begins with a stretch of a drive and explains more than it:
/// a false position, or a joint that halts, makes the command jump, and a drive lags behind.
bool explains_more(const ExplainedFault& fault, const JudgedStretch& drive) {
  const FaultKind kind = fault.claim.kind;
  const bool makes_a_jump = falsifies_position(kind) || (silences(kind) && kind != FaultKind::unknown);
  return makes_a_jump && std::abs(fault.claim.onset_s - drive.stretch.onset_s) < kAtOnce_s &&
         fault.evidence > drive.fault.evidence;
}

/// Returns two stretches of a drive as one.
SignalStretch joined(const SignalStretch& a, const SignalStretch& b) {
  SignalStretch out = a;
  out.end_s = b.end_s;
  out.nats = a.nats + b.nats;
  const auto mean = [&](double of_a, double of_b) { return (a.nats * of_a + b.nats * of_b) / out.nats; };
  out.loss = mean(a.loss, b.loss);
  out.loss_explains = mean(a.loss_explains, b.loss_explains);
  out.offset_explains = mean(a.offset_explains, b.offset_explains);
  return out;
}

/// Judges two stretches of a drive as one loss, which the signals do not show while little is commanded;
/// empty if two faults explain them better.
std::optional<JudgedStretch> as_one_loss(const JudgedStretch& a, const JudgedStretch& b, const LogFit* fit) {
  const SignalStretch &first = a.stretch, &second = b.stretch;
  if (first.joint != second.joint || first.loss < kLeastLoss || second.loss < kLeastLoss) return std::nullopt;
  if (std::min(first.loss, second.loss) < kAlikeLosses * std::max(first.loss, second.loss))
    return std::nullopt;
  if (first.end_s >= kNeverEnds) return std::nullopt;
  const bool is_balanced = fit != nullptr && first.balance_is_of_command;
  if (!is_balanced && second.onset_s - first.end_s > kQuietCommand_s) return std::nullopt;
  JudgedStretch out = judge_stretch(joined(first, second), fit);
  const double apart = a.fault.scores.front().nats + b.fault.scores.front().nats;
  if (!is_loss(out.fault.claim) || out.fault.scores.front().nats < apart) return std::nullopt;
  return out;
}

}  // namespace

JudgedStretch judge_stretch(const SignalStretch& stretch, const LogFit* fit) {
  std::vector<StretchScore> all = {score_free_form(stretch, fit)};
  for (std::optional<StretchScore> more : {of_loss(stretch, fit), of_sensor(stretch, fit)})
    if (more) all.push_back(std::move(*more));
  std::ranges::stable_sort(all, std::ranges::greater{}, &StretchScore::score);
  const StretchScore& best = all.front();
  JudgedStretch out{stretch, {}, best.in_balance};
  out.fault.claim = best.claim;
  out.fault.alarm_s = stretch.alarm_s;
  out.fault.evidence = best.gain;
  out.fault.limit = stretch.limit;
  for (const StretchScore& each : all) out.fault.scores.push_back({each.claim, each.score(), 1.0});
  const FaultLabel sensor{FaultKind::torque_sensor_error, stretch.joint};
  for (const StretchScore& each : all)
    if (each.claim.label() != best.claim.label() && each.claim.label() != sensor &&
        each.score() > kAlmostShare * best.score())
      out.fault.could_also_be.push_back(each.claim.label());
  const bool no_kind = best.claim.kind == FaultKind::unknown;
  const bool shows = best.in_balance > 0.0;
  if (no_kind && ((may_be_sensor(stretch) && !shows) || (shows && !stretch.balance_is_of_command)))
    out.fault.could_also_be.push_back(sensor);
  return out;
}

std::vector<FaultClaim> balance_claims(const std::vector<JudgedStretch>& stretches) {
  std::vector<FaultClaim> out;
  for (const JudgedStretch& judged : stretches)
    if (judged.in_balance > 0.0) out.push_back(judged.fault.claim);
  return out;
}

std::vector<JudgedStretch> judged_stretches(const std::vector<SignalStretch>& stretches,
                                            const std::vector<ExplainedFault>& others,
                                            std::vector<FaultClaim> known, const LogFit* fit) {
  std::vector<JudgedStretch> out;
  for (const ExplainedFault& other : others) known.push_back(other.claim);
  for (const SignalStretch& drive : stretches) {
    if (drive.pair != SignalPair::drive) continue;
    JudgedStretch judged = judge_stretch(drive, fit);
    if (std::ranges::any_of(others,
                            [&](const ExplainedFault& other) { return explains_more(other, judged); }))
      continue;
    const auto before = std::find_if(out.rbegin(), out.rend(), [&](const JudgedStretch& earlier) {
      return earlier.stretch.joint == drive.joint;
    });
    std::optional<JudgedStretch> one;
    if (before != out.rend()) one = as_one_loss(*before, judged, fit);
    if (one)
      *before = std::move(*one);
    else
      out.push_back(std::move(judged));
  }
  for (const JudgedStretch& drive : out) known.push_back(drive.fault.claim);
  for (const SignalStretch& law : stretches) {
    if (law.pair != SignalPair::control_law) continue;
    if (std::ranges::any_of(known, [&](const FaultClaim& claim) { return is_response(law, claim); }))
      continue;
    out.push_back(judge_stretch(law, fit));
    known.push_back(out.back().fault.claim);
  }
  std::ranges::stable_sort(out, {}, [](const JudgedStretch& judged) { return judged.stretch.onset_s; });
  return out;
}

bool answers_earlier_fault(const SignalStretch& stretch) {
  return stretch.pair == SignalPair::control_law && stretch.end_s - stretch.onset_s >= kLongAnswer_s;
}

}  // namespace faultline
