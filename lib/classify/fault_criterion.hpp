// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "lib/fault/fault_kind.hpp"

namespace faultline {

enum class CriterionKind {
  consecutive,  ///< the paper's: a fault's output is the largest for g consecutive samples (equation 9)
  log_odds,     ///< log odds of each fault against fault-free, summed while positive (Page's CUSUM), pass a
                ///< threshold
};
inline constexpr std::array kCriterionKinds{CriterionKind::log_odds, CriterionKind::consecutive};
const char* to_string(CriterionKind kind);

struct CriterionOptions {
  CriterionKind kind = CriterionKind::log_odds;
  int g = 3;                ///< samples; as many fault-free ones end an episode
  double threshold = 12.0;  ///< nats; as much for fault-free ends an episode
  double sample_cap = 2.0;  ///< nats: no single sample says more, whatever the networks put out
};

/// A stretch of samples that the classifier calls faulty.
struct SampleEpisode {
  FaultLabel label;  ///< the fault with the most support over the episode
  double onset_s =
      std::numeric_limits<double>::quiet_NaN();  ///< first sample of the run or sum that led to the alarm
  double alarm_s = std::numeric_limits<double>::quiet_NaN();  ///< sample at which the criterion was met
  double end_s = std::numeric_limits<double>::quiet_NaN();    ///< last sample that supports it
  double confidence =
      0.0;            ///< share of the samples from onset to end whose largest fault output is the label's
  bool open = false;  ///< still going on at the last sample
};

/// What crosses a segment border. Values of its own; start with a fresh one for each log.
struct CriterionState {
  int run_output = -1, run_length = 0;  // of equal largest outputs
  double run_start_s = 0.0, run_last_s = 0.0;
  Eigen::VectorXd sum, sum_start_s;  // of log odds, an output each
  Eigen::VectorXd votes, support;    // of each fault since the run or the sums began
  double healthy_sum = 0.0;          // for the end of an open episode
  std::optional<SampleEpisode> open;
};

/// What the outputs stand for.
struct OutputMeaning {
  std::vector<FaultLabel> classes;  ///< the last is `none`
  Eigen::VectorXd prior;            ///< of each class where the classifier was trained; empty = equal
};

/// Episodes that ended within these samples (outputs: classes x samples, times ascending). Samples with NaN
/// say nothing: they break a run and leave sums as they are. Where segment borders fall changes nothing.
std::vector<SampleEpisode> apply_criterion(const CriterionOptions& options, const OutputMeaning& meaning,
                                           const Eigen::Ref<const Eigen::VectorXd>& time,
                                           const Eigen::Ref<const Eigen::MatrixXd>& outputs,
                                           CriterionState& state);
/// The episode that is open after the last sample, if any.
std::optional<SampleEpisode> open_episode(const OutputMeaning& meaning, const CriterionState& state);

/// A run of known truth for tuning.
struct LabelledOutputs {
  Eigen::VectorXd time;
  Eigen::MatrixXd outputs;
  FaultLabel fault;
  double onset_s = std::numeric_limits<double>::infinity();
};

/// What a criterion does on labelled runs.
struct CriterionScore {
  CriterionOptions options;
  int false_alarms = 0;  ///< alarms before the onset or in fault-free runs
  double fault_free_hours = 0.0;
  int faulty_runs = 0;
  int detected = 0;                                                  ///< alarm at or after the onset
  int right = 0;                                                     ///< and kind and joint are right
  double median_delay_s = std::numeric_limits<double>::quiet_NaN();  ///< of the detected
};
CriterionScore score_criterion(const CriterionOptions& options, const OutputMeaning& meaning,
                               std::span<const LabelledOutputs> runs);

/// Tries g (or the threshold, for log odds) from small to large. Best: fewest false alarms among the settings
/// that find at least 90 % of what the most sensitive one finds, then most found, then the shortest delay;
/// and one step more for margin where that costs no detection.
struct CriterionSearch {
  CriterionOptions best;
  std::vector<CriterionScore> tried;
};
CriterionSearch tune_criterion(const CriterionOptions& start, const OutputMeaning& meaning,
                               std::span<const LabelledOutputs> runs);

}  // namespace faultline
