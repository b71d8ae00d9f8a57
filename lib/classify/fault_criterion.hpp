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
  int g = 3;  ///< samples of a fault that raise an alarm; as many fault-free samples end an episode
  double threshold = 12.0;  ///< nats that raise an alarm; as many against the fault end an episode
  double sample_cap = 2.0;  ///< nats; bound of the log odds of a single sample
};

/// A stretch of samples that the criterion assigns to a fault.
struct SampleEpisode {
  FaultLabel label;  ///< the fault with the most support over the episode
  double onset_s =
      std::numeric_limits<double>::quiet_NaN();  ///< first sample of the run or sum that led to the alarm
  double alarm_s = std::numeric_limits<double>::quiet_NaN();  ///< sample at which the criterion was met
  double end_s = std::numeric_limits<double>::quiet_NaN();    ///< last sample that supports the fault
  double confidence =
      0.0;  ///< share of the label among the samples counted for a fault, by their largest fault output
  bool open = false;  ///< not ended at the last sample
};

/// State carried over a segment border. Owns its data; start with a new one for each log.
struct CriterionState {
  int run_output = -1, run_length = 0;  // number of successive equal largest outputs
  double run_start_s = 0.0;
  Eigen::VectorXd sum, sum_start_s;  // of log odds, one for each output
  Eigen::VectorXd votes, support;    // of each fault, since the start of the run or the sums
  double healthy_sum = 0.0;          // evidence that an open episode has ended
  std::optional<SampleEpisode> open;
};

struct OutputMeaning {
  std::vector<FaultLabel> classes;  ///< the last is `none`
  Eigen::VectorXd prior;            ///< share of each class in the training samples; empty = equal
};

/// Returns the episodes that ended within these samples (outputs: classes x samples, times ascending).
/// Samples with NaN have no evidence: they break a run and do not change sums. The result does not depend on
/// the segment borders.
std::vector<SampleEpisode> apply_criterion(const CriterionOptions& options, const OutputMeaning& meaning,
                                           const Eigen::Ref<const Eigen::VectorXd>& time,
                                           const Eigen::Ref<const Eigen::MatrixXd>& outputs,
                                           CriterionState& state);
/// Returns the episode that is open after the last sample, if any.
std::optional<SampleEpisode> open_episode(const OutputMeaning& meaning, const CriterionState& state);

/// A run with its true fault, for tuning.
struct LabelledOutputs {
  Eigen::VectorXd time;
  Eigen::MatrixXd outputs;
  FaultLabel fault;
  double onset_s = std::numeric_limits<double>::infinity();
};

/// Performance of a criterion on labelled runs.
struct CriterionScore {
  CriterionOptions options;
  int false_alarms = 0;  ///< alarms before the onset or in fault-free runs
  int detected = 0;      ///< runs with an alarm at or after the onset
  int right = 0;         ///< detected runs with the right kind and joint
  double median_delay_s = std::numeric_limits<double>::quiet_NaN();  ///< of the detected runs
};
CriterionScore score_criterion(const CriterionOptions& options, const OutputMeaning& meaning,
                               std::span<const LabelledOutputs> runs);

/// Result of trying g (or the threshold, for log odds) from small to large. Best: fewest false alarms among
/// the settings that detect at least 90 % of the most that any setting detects, then most detected, then the
/// shortest delay; then, as a margin, the next larger setting if it keeps at least 97 % of the detections.
struct CriterionSearch {
  CriterionOptions best;
  std::vector<CriterionScore> tried;
};
CriterionSearch tune_criterion(const CriterionOptions& start, const OutputMeaning& meaning,
                               std::span<const LabelledOutputs> runs);

}  // namespace faultline
