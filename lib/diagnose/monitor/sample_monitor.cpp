// SPDX-License-Identifier: MIT
#include "lib/diagnose/monitor/sample_monitor.hpp"

#include "lib/residual/residuals.hpp"

namespace faultline {
namespace {

/// What one network alone says about the time of an episode.
Opinion opinion_on(const SampleEpisode& episode, const std::vector<SampleEpisode>& own) {
  for (const SampleEpisode& other : own)
    if (other.alarm_s <= episode.end_s && other.end_s >= episode.onset_s)
      return {other.label, other.confidence};
  return {};
}

CriterionWatch watch_of(const SampleMode& samples, const DiagnoseOptions& options) {
  CriterionOptions criterion =
      options.criterion == CriterionKind::consecutive ? samples.consecutive : samples.log_odds;
  if (options.g > 0) criterion.g = options.g;
  return {criterion, {samples.classifier.classes, samples.classifier.prior}};
}

}  // namespace

void CriterionWatch::take(const Eigen::VectorXd& time, const Eigen::MatrixXd& outputs) {
  for (const SampleEpisode& episode : apply_criterion(options_, meaning_, time, outputs, state_))
    episodes_.push_back(episode);
}

void CriterionWatch::finish() {
  if (const auto open = open_episode(meaning_, state_)) episodes_.push_back(*open);
}

SampleMonitor::SampleMonitor(const SampleMode& samples, const DiagnoseOptions& options)
    : classifier_(samples.classifier),
      average_(watch_of(samples, options)),
      mlp_(average_),
      rbfn_(average_) {}

void SampleMonitor::take(const Residuals& residuals) {
  const SampleOutputs outputs = classify_samples(classifier_, residuals);
  average_.take(outputs.time, outputs.average());
  mlp_.take(outputs.time, outputs.mlp);
  rbfn_.take(outputs.time, outputs.rbfn);
}

void SampleMonitor::finish() {
  for (CriterionWatch* each : {&average_, &mlp_, &rbfn_}) each->finish();
}

std::vector<SampleAlarm> SampleMonitor::alarms() const {
  std::vector<SampleAlarm> alarms;
  for (const SampleEpisode& episode : average_.episodes())
    alarms.push_back(
        {episode, {opinion_on(episode, mlp_.episodes()), opinion_on(episode, rbfn_.episodes())}});
  return alarms;
}

}  // namespace faultline
