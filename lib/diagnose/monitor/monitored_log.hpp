// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/classify/fault_criterion.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/explain/day/day_effects.hpp"
#include "lib/explain/decide_log.hpp"
#include "lib/explain/signal_stretch.hpp"
#include "lib/fault/fault_kind.hpp"
#include "lib/residual/relation/relation_detector.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {

/// A stretch of a log that the healthy robot does not explain, as found by monitoring and before the
/// decision.
struct MonitoredEpisode {
  ExplainedFault fault;
  double end_s = 0.0;                      ///< when the fault ended, or the last sample that was judged
  std::vector<JointResidual> residuals{};  ///< of the MLP, by joint, over kEpisodeResiduals_s from the onset

  double onset_s() const { return fault.claim.onset_s; }
  double alarm_s() const { return fault.alarm_s; }
};

/// A stretch of a log that the paper's fault criterion calls faulty, with the opinion of each network alone.
struct SampleAlarm {
  SampleEpisode episode;
  Opinions opinions;
};

/// The result of monitoring a log, before anything is decided.
struct MonitoredLog {
  LogFacts log;
  std::vector<JointResidual> residuals;            ///< of the MLP, over the whole log
  std::vector<MonitoredEpisode> episodes;          ///< found by the regression
  std::vector<SampleAlarm> sample_alarms;          ///< found by the paper's fault criterion
  std::vector<DayEffect> day;                      ///< empty if no window was explained
  std::vector<RelationEpisode> relation_episodes;  ///< of the second residuals, by onset
  std::vector<JudgedStretch> stretches;            ///< those that are faults; `id` is the episode's index
  std::vector<double> relations_judged_s;  ///< by relation of the model: for how long it was judged, s
  std::vector<double> relations_beyond_s;  ///< by relation: for how long beyond the learned inputs, s
  std::vector<double> roughness;           ///< Diagnosis::roughness
  double judged_share = 1.0;               ///< Diagnosis::judged_share
  EvidenceScore score{};                   ///< Diagnosis::score
};

}  // namespace faultline
