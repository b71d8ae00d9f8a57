// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/reproduce/runs/alarm_score.hpp"

namespace faultline {

/// How much is simulated for one controller and seed.
struct RunPlan {
  RunSet training{.faulty = 150, .fault_free_h = 1.0, .after_onset_s = 2.0};
  RunSet tuning{.faulty = 150, .fault_free_h = 5.0};
  RunSet test{};
  int filter_faulty = 60;  ///< of the test runs: those that filters watch
  double filter_fault_free_h = 2.0;
  int filter_tuning_faulty = 15;  ///< of the tuning runs, likewise
  double filter_tuning_h = 0.5;
  int reference_faulty = 30;  ///< of the test runs: those that filters on the true robot watch
  double reference_h = 0.5;
  double healthy_log_s = 120.0;      ///< of each of the three logs to learn from
  int generator_trajectories = 100;  ///< of the paper's generator
  int generator_iterations = 60;     ///< of its trainer
  int patterns_per_class = 6000;     ///< of the best recipe's classifiers
  std::vector<double> sigmas = {0.0, 0.01, 0.1};
  std::vector<double> learned_sigmas;                      ///< where `learn` and `diagnose` run
  std::vector<double> filtered_sigmas = {0.0, 0.01, 0.1};  ///< where filters run on the true robot
  bool quick = false;
};
RunPlan run_plan(ControllerVariant controller, bool quick);

/// A detector on the test runs, its setting chosen on the tuning runs.
struct DetectorResult {
  std::string detector;
  std::string decision;
  double setting = 0.0;  ///< g, or nats
  AlarmScore score;
};

/// A detector on the test runs for g = 1, 2, ...
struct TradeOff {
  std::string detector;
  std::vector<AlarmScore> by_g;
};

/// How often two networks name the same class, over samples of faulty runs after the onset.
struct Agreement {
  long samples = 0;
  long same = 0;
};

struct ConditionResult {
  double sigma = 0.0;
  std::vector<DetectorResult> detectors;
  std::vector<TradeOff> trade_offs;
  Agreement best_networks{};  ///< MLP and RBFN of the best recipe, in the test runs
};

/// Every detector under one controller, a result for each noise; experiment `seed`.
std::vector<ConditionResult> run_conditions(ControllerVariant controller, const RunPlan& plan,
                                            std::uint64_t seed);

/// Names of detectors that goals and comparisons ask for.
namespace detector_name {
inline constexpr const char* kBestMlp = "best recipe, MLP";
inline constexpr const char* kBestRbfn = "best recipe, RBFN";
inline constexpr const char* kBestAverage = "best recipe, average of both";
inline constexpr const char* kBestCases = "best recipe, both and cases";
inline constexpr const char* kFilters = "filters for free joints, identified robot";
inline constexpr const char* kProductMlp = "learn and diagnose, named by MLP";
inline constexpr const char* kProductRbfn = "learn and diagnose, named by RBFN";
inline constexpr const char* kProductCases = "learn and diagnose, both and cases";
inline constexpr const char* kReference = "reference: filters for free joints, true robot";
}  // namespace detector_name

namespace decision_name {
inline constexpr const char* kConsecutive = "g in a row";
inline constexpr const char* kLogOdds = "summed log odds";
inline constexpr const char* kRegression = "regression over the log";
}  // namespace decision_name

}  // namespace faultline
