// SPDX-License-Identifier: MIT
#include "lib/evidence/bank.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/evidence/trigger.hpp"

namespace faultline {
namespace {

/// A code that changes under the stuck hypothesis counts against it this much (nats): more than the threshold
/// of an alarm, so that one change ends the suspicion.
constexpr double kCodeChanged = -25.0;
/// What it costs to call a row misread (nats): about one row in a million is.
constexpr double kMisread = 14.0;
/// How much likelier than any fault a change of the work piece is (nats), which happens every few seconds.
constexpr double kHabit = 10.0;
/// How much less likely the same change twice in a row is.
constexpr double kAgain = 20.0;
/// Width of a code over the standard deviation of the error it makes, the square root of 12.
constexpr double kCodesInStd = 3.4641;
/// Codes that never repeated in the healthy logs may do so once in this many samples.
constexpr double kSmallestShare = 1e-4;

/// Codes so coarse that healthy joints repeat them: the log likelihood of a reading that was certain.
double certain_code(const FollowedSample& at, int j) {
  double codes = elementary::log(kCodesInStd * at.q_std[j]);
  if (std::isfinite(at.dq[j])) codes += elementary::log(kCodesInStd * at.dq_std[j]);
  return -codes;
}

/// Nothing is likelier than certain, though the density of a Gaussian as wide as a code is where it repeats.
double at_most_certain(double log_likelihood, const MotionModel& model, const FollowedSample& at, int j) {
  if (!at.repeats[j] || repeats_mean_stuck(model, j)) return log_likelihood;
  return std::min(log_likelihood, certain_code(at, j));
}

double log_ratio_of_stuck(const MotionModel& model, const FollowedSample& at, int j) {
  if (!at.repeats[j]) return kCodeChanged;
  if (repeats_mean_stuck(model, j))
    return -elementary::log(std::max(model.repeat_share[j], kSmallestShare)) + 0.5 * at.chi_square[j];
  const double certain = certain_code(at, j);
  return certain - std::min(at.log_likelihood[j], certain);
}

}  // namespace

Bank::Bank(const MotionModel& model, const FaultDynamics& dynamics, const std::vector<Hypothesis>& hypotheses,
           const JointFlags& closed)
    : model_(model), dynamics_(dynamics), hypotheses_(hypotheses), closed_(closed) {}

bool Bank::asks_for(const Hypothesis& hypothesis) const {
  const int joint = hypothesis.joint_index();
  if (is_everywhere(hypothesis))
    return std::none_of(closed_.begin(), closed_.end(), [](bool closed) { return closed; });
  return joint < 0 || !closed_[joint];
}

RunningHypothesis Bank::start(int hypothesis, std::int64_t onset, const FollowedSample& before,
                              const FollowedSample& at, std::optional<double> duration_s) const {
  RunningHypothesis running;
  running.hypothesis = hypothesis;
  running.onset = onset;
  running.onset_s = at.time - 0.5 * at.dt;
  running.duration_s = duration_s.value_or(hypotheses_[hypothesis].duration_s);
  running.state = with_sizes(before.posterior, hypotheses_[hypothesis], model_.priors);
  const Step step = step_to(at, before.torque, before.torque_missing);
  if (hypotheses_[hypothesis].form == HypothesisForm::work_piece)
    change_work_piece(running, step);
  else
    predict_onset(running.state, model_, dynamics_, step, hypothesis_of(running));
  if (is_misread(hypotheses_[hypothesis]))
    pass_over(running, at);
  else
    observe(running, at);
  return running;
}

/// The tip carries another mass from some moment within the step on.
void Bank::change_work_piece(RunningHypothesis& running, const Step& step) const {
  GaussianState late = running.state;
  predict(late, model_, dynamics_, step, nullptr, 0.0);
  GaussianState& state = running.state;
  add_work_piece(state, model_, hypotheses_[running.hypothesis].work_piece_kg);
  predict(state, model_, dynamics_, step, nullptr, 0.0);
  blend_with(state, late.mean, 2 * model_.joints());
  const bool again = hypotheses_[running.hypothesis].work_piece_kg == last_change_kg_;
  running.log_likelihood_ratio += again ? kHabit - kAgain : kHabit;
}

/// A misread row says nothing of the robot; that a row is misread at all costs kMisread.
void Bank::pass_over(RunningHypothesis& running, const FollowedSample& at) const {
  GaussianState scratch = running.state;
  running.log_likelihood_ratio -= kMisread;
  for (int j = 0; j < model_.joints(); ++j) {
    const JointObservation seen = observe_joint(scratch, model_.joints(), at, j);
    if (!at.pressed[j])
      running.log_likelihood_ratio += seen.log_likelihood + 0.5 * seen.chi_square - at.log_likelihood[j];
  }
}

Hypothesis Bank::hypothesis_of(const RunningHypothesis& running) const {
  Hypothesis hypothesis = hypotheses_[running.hypothesis];
  hypothesis.duration_s = running.duration_s;
  return hypothesis;
}

void Bank::advance(RunningHypothesis& running, const FollowedSample& before, const FollowedSample& at) const {
  const Hypothesis hypothesis = hypothesis_of(running);
  predict(running.state, model_, dynamics_, step_to(at, before.torque, before.torque_missing), &hypothesis,
          before.time - running.onset_s);
  observe(running, at);
}

void Bank::observe(RunningHypothesis& running, const FollowedSample& at) const {
  const Hypothesis& hypothesis = hypotheses_[running.hypothesis];
  const int n = model_.joints(), joint = hypothesis.joint_index();
  for (int j = 0; j < n; ++j) {
    if (j == joint && hypothesis.label.kind == FaultKind::stuck_encoder) {
      if (!at.pressed[j]) running.log_likelihood_ratio += log_ratio_of_stuck(model_, at, j);
      continue;
    }
    const SensorError error =
        j == joint ? sensor_error(hypothesis, model_.healthy_states(), at.time - running.onset_s)
                   : SensorError{};
    const JointObservation seen = observe_joint(running.state, n, at, j, error);
    if (at.pressed[j]) continue;
    running.log_likelihood_ratio += at_most_certain(seen.log_likelihood, model_, at, j) -
                                    at_most_certain(at.log_likelihood[j], model_, at, j);
    if (at.in_range && !at.repeats[j] && std::isfinite(at.q[j]))
      running.surprise.add(j, seen.whitened_q, seen.whitened_dq, std::isfinite(at.dq[j]));
  }
  clamp_sizes(running.state, hypothesis, model_);
  if (describe(hypothesis.label.kind).course != SizeCourse::pulse) return;
  for (int s = 0; s < hypothesis.sizes; ++s)
    running.impulse[joint_of_size(hypothesis, s)] += running.state.mean[model_.healthy_states() + s] * at.dt;
}

HypothesisEvidence Bank::evidence_of(const RunningHypothesis& running) const {
  HypothesisEvidence evidence;
  evidence.log_likelihood_ratio = running.log_likelihood_ratio;
  evidence.onset_s = running.onset_s;
  const int first = model_.healthy_states();
  evidence.impulse = running.impulse;
  evidence.surprise = running.surprise;
  for (int s = 0; s < std::min(hypotheses_[running.hypothesis].sizes, 2); ++s) {
    evidence.size[s] = running.state.mean[first + s];
    evidence.size_std[s] = std::sqrt(std::max(running.state.p(first + s, first + s), 0.0));
  }
  return evidence;
}

}  // namespace faultline
