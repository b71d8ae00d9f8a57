// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/evidence/episode_evidence.hpp"
#include "lib/evidence/filter/follower.hpp"
#include "lib/evidence/surprise.hpp"

namespace faultline {

/// One hypothesis from one onset on: its filter and its log likelihood ratio against the healthy filter.
struct RunningHypothesis {
  int hypothesis = 0;       ///< index into the bank
  std::int64_t onset = 0;   ///< the fault begins within the step into this sample (index into the history)
  double onset_s = 0.0;     ///< middle of that step
  double duration_s = 0.0;  ///< of a pulse
  double log_likelihood_ratio = 0.0;
  JointArray impulse{};  ///< of a collision so far, a joint each, N m s or N s
  Surprise surprise;     ///< what its own filter leaves unexplained
  GaussianState state;
};

/// Runs hypotheses over samples that the healthy filter has followed. The history is a span of consecutive
/// samples; sample 0 is never compared, it only gives states to start from.
class Bank {
 public:
  /// At the joints that are `closed` no fault is asked for, and no push on all.
  Bank(const MotionModel& model, const FaultDynamics& dynamics, const std::vector<Hypothesis>& hypotheses,
       const JointFlags& closed = {});

  /// A filter that starts from the healthy state before `onset` (>= 1), advanced by that one sample; a pulse
  /// of its hypothesis' duration or of `duration_s`.
  RunningHypothesis start(int hypothesis, std::int64_t onset, const FollowedSample& before,
                          const FollowedSample& at, std::optional<double> duration_s = std::nullopt) const;
  /// Advances a filter by one sample.
  void advance(RunningHypothesis& running, const FollowedSample& before, const FollowedSample& at) const;

  /// A work piece was picked up or put down: the same again is as unlikely as the return of it that nobody
  /// saw.
  void work_piece_changed(double kg) { last_change_kg_ = kg; }

  const std::vector<Hypothesis>& hypotheses() const { return hypotheses_; }
  int joints() const { return model_.joints(); }
  const MotionModel& model() const { return model_; }
  bool asks_for(const Hypothesis& hypothesis) const;
  HypothesisEvidence evidence_of(const RunningHypothesis& running) const;

 private:
  Hypothesis hypothesis_of(const RunningHypothesis& running) const;
  void change_work_piece(RunningHypothesis& running, const Step& step) const;
  void pass_over(RunningHypothesis& running, const FollowedSample& at) const;
  void observe(RunningHypothesis& running, const FollowedSample& at) const;

  const MotionModel& model_;
  const FaultDynamics& dynamics_;
  const std::vector<Hypothesis>& hypotheses_;
  JointFlags closed_;
  double last_change_kg_ = 0.0;  ///< of the work piece
};

}  // namespace faultline
