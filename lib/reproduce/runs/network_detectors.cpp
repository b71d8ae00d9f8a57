// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/network_detectors.hpp"

#include "lib/reproduce/runs/dual_decision.hpp"

namespace faultline {
namespace {

constexpr int kMostG = 30;
constexpr double kSampleCap = 10.0;      // nats; the least output that counts limits it to about as much
constexpr double kLeastSuspicion = 1.5;  // nats
constexpr double kLargestThreshold = 70.0;
constexpr double kThresholdStep = 1.15;
constexpr int kCasesOfClass = 100;
constexpr int kFalseCases = 300;

constexpr const char* kNetworks[] = {"MLP", "RBFN", "average of both"};

std::vector<double> thresholds() {
  std::vector<double> values;
  for (double value = kLeastSuspicion; value < kLargestThreshold; value *= kThresholdStep)
    values.push_back(value);
  return values;
}

/// Scores of every way to decide, a score a setting.
struct Sweep {
  std::vector<AlarmScore> consecutive[3], log_odds[3];  // of each network and their average
  std::vector<AlarmScore> cases_at_samples, cases_of_episodes;
  Agreement agreement;
};

void add(std::vector<AlarmScore>& scores, const ExperimentRun& run, const std::vector<Alarms>& alarms) {
  scores.resize(alarms.size());
  for (std::size_t i = 0; i < alarms.size(); ++i) scores[i].add(run, alarms[i]);
}

void add(Agreement& agreement, const ExperimentRun& run, const SampleOutputs& outputs) {
  for (Eigen::Index i = 0; i < outputs.time.size() && run.faulty(); ++i) {
    if (outputs.time[i] <= run.onset_s) continue;
    if (!outputs.mlp.col(i).allFinite() || !outputs.rbfn.col(i).allFinite()) continue;
    Eigen::Index by_mlp = 0, by_rbfn = 0;
    outputs.mlp.col(i).maxCoeff(&by_mlp);
    outputs.rbfn.col(i).maxCoeff(&by_rbfn);
    ++agreement.samples;
    agreement.same += by_mlp == by_rbfn;
  }
}

struct Cases {
  CaseBase samples, suspicions;
};

Sweep sweep(const SampleDetector& detector, const Cases& cases, std::span<const ExperimentRun> runs,
            bool sum_log_odds) {
  const SampleClassifier& classifier = detector.classifier;
  const OutputMeaning meaning{classifier.classes, classifier.prior};
  const std::vector<double> tried = thresholds();
  Sweep out;
  for (const ExperimentRun& run : runs) {
    const SampleOutputs outputs = outputs_of(detector, run.log);
    add(out.agreement, run, outputs);
    const Eigen::MatrixXd networks[] = {outputs.mlp, outputs.rbfn, outputs.average()};
    for (int n = 0; n < 3; ++n) {
      add(out.consecutive[n], run, sweep_consecutive(meaning, outputs.time, networks[n], kMostG));
      if (sum_log_odds)
        add(out.log_odds[n], run, sweep_log_odds(meaning, outputs.time, networks[n], tried, kSampleCap));
    }
    add(out.cases_at_samples, run,
        sweep_consecutive(meaning, outputs.time, decide_samples(outputs, meaning.classes, cases.samples),
                          kMostG));
    if (sum_log_odds)
      add(out.cases_of_episodes, run,
          decide_suspicions(suspicions_of(classifier, outputs, kSampleCap, kLeastSuspicion), meaning.classes,
                            cases.suspicions, tried));
  }
  return out;
}

/// The setting that the tuning runs choose, measured on the test runs.
DetectorResult chosen(const std::string& detector, const char* decision,
                      const std::vector<AlarmScore>& tuning, const std::vector<AlarmScore>& test,
                      bool counts) {
  const int setting = choose_setting(tuning);
  return {detector, decision, counts ? setting + 1.0 : thresholds()[setting], test[setting]};
}

}  // namespace

void watch_with_networks(const SampleDetector& detector, const ConditionRuns& runs, const std::string& recipe,
                         bool sum_log_odds, ConditionResult& result) {
  Cases cases{cases_of_samples(detector, runs.training, kCasesOfClass), {}};
  if (sum_log_odds)
    cases.suspicions = cases_of_suspicions(detector, runs.tuning, kSampleCap, kLeastSuspicion, kFalseCases);
  const Sweep tuning = sweep(detector, cases, runs.tuning, sum_log_odds);
  const Sweep test = sweep(detector, cases, runs.test, sum_log_odds);
  if (sum_log_odds) result.best_networks = test.agreement;
  for (int n = 0; n < 3; ++n) {
    const std::string name = recipe + ", " + kNetworks[n];
    result.trade_offs.push_back({name, test.consecutive[n]});
    result.detectors.push_back(
        chosen(name, decision_name::kConsecutive, tuning.consecutive[n], test.consecutive[n], true));
    if (sum_log_odds)
      result.detectors.push_back(
          chosen(name, decision_name::kLogOdds, tuning.log_odds[n], test.log_odds[n], false));
  }
  const std::string name = recipe + ", both and cases";
  result.trade_offs.push_back({name, test.cases_at_samples});
  result.detectors.push_back(
      chosen(name, decision_name::kConsecutive, tuning.cases_at_samples, test.cases_at_samples, true));
  if (sum_log_odds)
    result.detectors.push_back(
        chosen(name, decision_name::kLogOdds, tuning.cases_of_episodes, test.cases_of_episodes, false));
}

}  // namespace faultline
