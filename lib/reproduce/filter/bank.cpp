// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/bank.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
Bank::Bank(const MotionModel& model, const FaultDynamics& dynamics, const std::vector<Hypothesis>& hypotheses)
    : model_(model), dynamics_(dynamics), hypotheses_(hypotheses) {}

RunningHypothesis Bank::start(int hypothesis, std::int64_t onset, const FollowedSample& before,
                              const FollowedSample& at) const {
  RunningHypothesis running;
  running.hypothesis = hypothesis;
  running.onset = onset;
  running.onset_s = at.time - 0.5 * at.dt;
  running.state = with_sizes(before.posterior, hypotheses_[hypothesis], model_.priors);
  const Step step = step_to(at, before.torque, before.torque_missing);
  predict_onset(running.state, model_, dynamics_, step, hypotheses_[hypothesis]);
  observe(running, at);
  return running;
}

void Bank::advance(RunningHypothesis& running, const FollowedSample& before, const FollowedSample& at) const {
  const Hypothesis& hypothesis = hypotheses_[running.hypothesis];
  predict(running.state, model_, dynamics_, step_to(at, before.torque, before.torque_missing), &hypothesis,
          before.time - running.onset_s);
  observe(running, at);
}

void Bank::observe(RunningHypothesis& running, const FollowedSample& at) const {
  const Hypothesis& hypothesis = hypotheses_[running.hypothesis];
  const int n = model_.joints(), joint = hypothesis.joint_index();
  for (int j = 0; j < n; ++j) {
    const SensorError error =
        j == joint ? sensor_error(hypothesis, model_.healthy_states(), at.time - running.onset_s)
                   : SensorError{};
    const JointObservation seen = observe_joint(running.state, n, at, j, error);
    if (!at.pressed[j]) running.log_likelihood_ratio += seen.log_likelihood - at.log_likelihood[j];
  }
  clamp_sizes(running.state, hypothesis, model_);
}

}  // namespace faultline
