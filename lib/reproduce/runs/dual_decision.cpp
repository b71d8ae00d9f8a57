// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/dual_decision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/diagnose/decision.hpp"

namespace faultline {
namespace {

using Eigen::Index;

constexpr int kOfEachRun = 3;  // suspicions of a faulty run that become cases

class RunningSums {
 public:
  explicit RunningSums(Eigen::MatrixXd odds)
      : odds_(std::move(odds)), sum_(Eigen::VectorXd::Zero(odds_.rows())) {}

  NetworkSum take(Index i) {
    sum_ = (sum_ + odds_.col(i)).cwiseMax(0.0);
    NetworkSum out{.sum = sum_};
    Index largest = 0;
    out.best = sum_.maxCoeff(&largest);
    out.output = static_cast<int>(largest);
    out.last = odds_(largest, i);
    return out;
  }

 private:
  Eigen::MatrixXd odds_;
  Eigen::VectorXd sum_;
};

Opinion opinion_of(const NetworkSum& sum, const std::vector<FaultLabel>& classes, double threshold) {
  const double certainty = std::min(0.5 * sum.best / threshold, 1.0);
  if (sum.best >= threshold) return {classes[sum.output], certainty};
  return {{}, 1.0 - certainty};
}

/// The sums were not zero in between.
bool continues(const SuspectSample& earlier, const SuspectSample& later) {
  const double samples = std::round((later.time_s - earlier.time_s) / kSamplePeriod);
  return later.samples - earlier.samples == static_cast<int>(samples);
}

Case known_case(Episode episode, const FaultLabel& label) {
  Case c;
  c.episode = std::move(episode);
  c.decision = c.label = label;
  c.outcome = CaseOutcome::confirmed;
  c.origin = "simulated";
  return c;
}

/// A false suspicion counts once: at its height.
std::vector<SuspectSample> heights(const std::vector<SuspectSample>& suspicions, double before_s) {
  std::vector<SuspectSample> out;
  for (const SuspectSample& s : suspicions) {
    if (s.time_s >= before_s) break;
    const bool goes_on = !out.empty() && continues(out.back(), s);
    if (!goes_on)
      out.push_back(s);
    else if (s.largest() > out.back().largest())
      out.back() = s;
  }
  return out;
}

/// Every so many-th, at most `most`.
template <typename Value>
std::vector<Value> thinned(const std::vector<Value>& values, int most) {
  std::vector<Value> out;
  const std::size_t step = values.size() / std::max(most, 1) + 1;
  for (std::size_t i = 0; i < values.size(); i += step) out.push_back(values[i]);
  return out;
}

/// By networks and cases alone.
Decision decision_of(const Episode& episode, const CaseBase& cases) {
  return opinion_on(episode, votes_on(episode, cases));
}

Opinion opinion_of(const Eigen::VectorXd& outputs, const std::vector<FaultLabel>& classes) {
  Index best = 0;
  const double largest = outputs.maxCoeff(&best);
  return {classes[best], std::clamp(largest, 0.0, 1.0)};
}

/// A freed robot that has run away leaves samples that nothing can be said of.
bool says_something(const SampleOutputs& outputs, Index i) {
  return outputs.mlp.col(i).allFinite() && outputs.rbfn.col(i).allFinite();
}

Episode sample_episode(const SampleOutputs& outputs, Index i, const std::vector<FaultLabel>& classes) {
  Episode episode;
  for (const Eigen::MatrixXd* of : {&outputs.mlp, &outputs.rbfn})
    for (Index c = 0; c < of->rows(); ++c) episode.features.push_back((*of)(c, i));
  episode.mlp = opinion_of(outputs.mlp.col(i), classes);
  episode.rbfn = opinion_of(outputs.rbfn.col(i), classes);
  episode.evidence = 0.0;
  return episode;
}

Index class_of(const std::vector<FaultLabel>& classes, const FaultLabel& label) {
  const auto found = std::find(classes.begin(), classes.end(), label);
  return found == classes.end() ? static_cast<Index>(classes.size()) - 1 : found - classes.begin();
}

}  // namespace

double SuspectSample::largest() const { return std::max(mlp.best, rbfn.best); }

std::vector<SuspectSample> suspect_samples(const SampleClassifier& classifier, const SampleOutputs& outputs,
                                           double sample_cap, double least) {
  const OutputMeaning meaning{classifier.classes, classifier.prior};
  RunningSums mlp(sample_log_odds(meaning, outputs.mlp, sample_cap));
  RunningSums rbfn(sample_log_odds(meaning, outputs.rbfn, sample_cap));
  std::vector<SuspectSample> suspicions;
  SuspectSample now;
  for (Index i = 0; i < outputs.time.size(); ++i) {
    if (!outputs.mlp.col(i).allFinite() || !outputs.rbfn.col(i).allFinite()) continue;
    now.time_s = outputs.time[i];
    now.mlp = mlp.take(i);
    now.rbfn = rbfn.take(i);
    now.samples = now.largest() > 0.0 ? now.samples + 1 : 0;
    if (now.largest() >= least) suspicions.push_back(now);
  }
  return suspicions;
}

std::vector<std::string> suspect_feature_names(int faults) {
  std::vector<std::string> names;
  for (const std::string network : {"mlp", "rbfn"}) {
    for (int c = 1; c <= faults; ++c) names.push_back(network + "_sum_" + std::to_string(c));
    names.push_back(network + "_last");
  }
  names.emplace_back("samples");
  return names;
}

Episode episode_of(const SuspectSample& s, const std::vector<FaultLabel>& classes, double threshold) {
  Episode episode;
  for (const NetworkSum* network : {&s.mlp, &s.rbfn}) {
    for (const double sum : network->sum) episode.features.push_back(elementary::log1p(sum));
    episode.features.push_back(network->last);
  }
  episode.features.push_back(elementary::log(1.0 + s.samples));
  episode.mlp = opinion_of(s.mlp, classes, threshold);
  episode.rbfn = opinion_of(s.rbfn, classes, threshold);
  episode.evidence = s.largest();
  return episode;
}

CaseBase cases_of_suspects(const SampleDetector& detector, std::span<const ExperimentRun> runs,
                           double sample_cap, double least, int most_false) {
  CaseBase cases(suspect_feature_names(static_cast<int>(detector.classifier.classes.size()) - 1));
  std::vector<SuspectSample> wrong;
  const auto& classes = detector.classifier.classes;
  for (const ExperimentRun& run : runs) {
    const auto suspicions =
        suspect_samples(detector.classifier, outputs_of(detector, run.log), sample_cap, least);
    for (const SuspectSample& s : heights(suspicions, run.onset_s)) wrong.push_back(s);
    int taken = 0;
    for (const SuspectSample& s : suspicions)
      if (s.time_s >= run.onset_s && taken++ < kOfEachRun)
        cases.retain(known_case(episode_of(s, classes, least), run.fault));
  }
  for (const SuspectSample& s : thinned(wrong, most_false))
    cases.retain(known_case(episode_of(s, classes, least), {}));
  cases.learn();
  return cases;
}

std::vector<Alarms> decide_suspects(const std::vector<SuspectSample>& suspicions,
                                    const std::vector<FaultLabel>& classes, const CaseBase& cases,
                                    std::span<const double> thresholds) {
  std::vector<Alarms> alarms(thresholds.size());
  for (std::size_t t = 0; t < thresholds.size(); ++t) {
    const SuspectSample* open = nullptr;  // the last one of the alarm that still stands
    for (const SuspectSample& s : suspicions) {
      if (open && continues(*open, s)) {
        open = &s;
        continue;
      }
      open = nullptr;
      if (s.largest() < thresholds[t]) continue;
      const Decision decision = decision_of(episode_of(s, classes, thresholds[t]), cases);
      if (decision.label.joint.is_none()) continue;
      alarms[t].push_back({s.time_s, decision.label});
      open = &s;
    }
  }
  return alarms;
}

CaseBase cases_of_samples(const SampleDetector& detector, std::span<const ExperimentRun> runs,
                          int most_of_class) {
  const auto& classes = detector.classifier.classes;
  std::vector<std::vector<Episode>> of_class(classes.size());
  std::vector<std::string> names;
  for (const char* network : {"mlp_", "rbfn_"})
    for (std::size_t c = 0; c < classes.size(); ++c) names.push_back(network + std::to_string(c + 1));
  for (const ExperimentRun& run : runs) {
    const SampleOutputs outputs = outputs_of(detector, run.log);
    for (Index i = 0; i < outputs.time.size(); ++i)
      if (says_something(outputs, i))
        of_class[class_of(classes, outputs.time[i] > run.onset_s ? run.fault : FaultLabel{})].push_back(
            sample_episode(outputs, i, classes));
  }
  CaseBase cases(names);
  for (std::size_t c = 0; c < classes.size(); ++c)
    for (const Episode& episode : thinned(of_class[c], most_of_class))
      cases.retain(known_case(episode, classes[c]));
  cases.learn();
  return cases;
}

Eigen::MatrixXd decide_samples(const SampleOutputs& outputs, const std::vector<FaultLabel>& classes,
                               const CaseBase& cases) {
  Eigen::MatrixXd decided = Eigen::MatrixXd::Zero(outputs.mlp.rows(), outputs.mlp.cols());
  for (Index i = 0; i < decided.cols(); ++i) {
    if (!says_something(outputs, i)) {
      decided.col(i).setConstant(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const Episode episode = sample_episode(outputs, i, classes);
    const bool agree = episode.mlp.label == episode.rbfn.label;
    const FaultLabel label = agree ? episode.mlp.label : decision_of(episode, cases).label;
    decided(class_of(classes, label), i) = 1.0;
  }
  return decided;
}

}  // namespace faultline
