// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/network_sums.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/reproduce/runs/criterion_sweep.hpp"

namespace faultline {
namespace {

using Eigen::Index;

/// The running sums of one network.
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

}  // namespace

double Suspicion::largest() const { return std::max(mlp.best, rbfn.best); }

bool continues(const Suspicion& earlier, const Suspicion& later) {
  const double samples = std::round((later.time_s - earlier.time_s) / kSamplePeriod);
  return later.samples - earlier.samples == static_cast<int>(samples);
}

std::vector<Suspicion> suspicions_of(const SampleClassifier& classifier, const SampleOutputs& outputs,
                                     double sample_cap, double least) {
  const OutputMeaning meaning{classifier.classes, classifier.prior};
  RunningSums mlp(sample_log_odds(meaning, outputs.mlp, sample_cap));
  RunningSums rbfn(sample_log_odds(meaning, outputs.rbfn, sample_cap));
  std::vector<Suspicion> suspicions;
  Suspicion now;
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

std::vector<std::string> suspicion_feature_names(int faults) {
  std::vector<std::string> names;
  for (const std::string network : {"mlp", "rbfn"}) {
    for (int c = 1; c <= faults; ++c) names.push_back(network + "_sum_" + std::to_string(c));
    names.push_back(network + "_last");
  }
  names.emplace_back("samples");
  return names;
}

Episode episode_of(const Suspicion& s, const std::vector<FaultLabel>& classes, double threshold) {
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

}  // namespace faultline
