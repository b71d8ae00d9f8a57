// SPDX-License-Identifier: MIT
#include "lib/classify/fault_criterion.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr double kFewestFound = 0.9;  // of the largest number of detections of any setting
constexpr double kFreeMargin = 0.97;  // least share of the detections that the next larger setting must keep

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kLeastOutput = 1e-4;  // lower bound, as linear outputs may be negative and have no logarithm

/// Returns the capped log odds of every fault against `none`, without the influence of the class shares in
/// training; 0 for `none` itself.
VectorXd log_odds(const CriterionOptions& options, const OutputMeaning& meaning, const VectorXd& outputs) {
  const Index none = outputs.size() - 1;
  VectorXd odds = VectorXd::Zero(outputs.size());
  for (Index c = 0; c < none; ++c) {
    odds[c] = elementary::log(std::max(outputs[c], kLeastOutput) / std::max(outputs[none], kLeastOutput));
    if (meaning.prior.size() == outputs.size())
      odds[c] -= elementary::log(meaning.prior[c] / meaning.prior[none]);
    odds[c] = std::clamp(odds[c], -options.sample_cap, options.sample_cap);
  }
  return odds;
}

Index largest_fault(const VectorXd& values) {
  Index best = 0;
  values.head(values.size() - 1).maxCoeff(&best);
  return best;
}

void open_at(CriterionState& state, double onset_s, double alarm_s) {
  state.open =
      SampleEpisode{.label = {}, .onset_s = onset_s, .alarm_s = alarm_s, .end_s = alarm_s, .open = true};
}

SampleEpisode finished(const OutputMeaning& meaning, const CriterionState& state, bool open) {
  SampleEpisode episode = *state.open;
  const Index best = largest_fault(state.support);
  const double votes = state.votes.head(state.votes.size() - 1).sum();
  episode.label = meaning.classes[best];
  episode.confidence = votes > 0.0 ? state.votes[best] / votes : 0.0;
  episode.open = open;
  return episode;
}

/// Counts the sample for the fault with the largest output.
void vote(CriterionState& state, const VectorXd& outputs, const VectorXd& support) {
  state.votes[largest_fault(outputs)] += 1.0;
  state.support += support;
}

void forget(CriterionState& state) {
  state.votes.setZero();
  state.support.setZero();
  state.sum.setZero();
  state.healthy_sum = 0.0;
  state.open.reset();
}

/// Applies equation 9 of the paper to a sample. Returns whether the sample ends the open episode.
bool consecutive_step(const CriterionOptions& options, double time, const VectorXd& outputs,
                      CriterionState& state) {
  if (!outputs.allFinite()) {
    state.run_output = -1;
    state.run_length = 0;
    return false;
  }
  const Index none = outputs.size() - 1;
  Index largest = 0;
  outputs.maxCoeff(&largest);
  if (largest != state.run_output) {
    state.run_output = static_cast<int>(largest);
    state.run_length = 0;
    state.run_start_s = time;
    if (!state.open) forget(state);
  }
  ++state.run_length;
  if (largest != none) {
    VectorXd support = VectorXd::Zero(outputs.size());
    support[largest] = 1.0;
    vote(state, outputs, support);
    if (!state.open && state.run_length >= options.g) open_at(state, state.run_start_s, time);
    if (state.open) state.open->end_s = time;
    return false;
  }
  return state.open && state.run_length >= options.g;
}

/// Updates Page's sums. Returns whether the sample ends the open episode.
bool log_odds_step(const CriterionOptions& options, const OutputMeaning& meaning, double time,
                   const VectorXd& outputs, CriterionState& state) {
  if (!outputs.allFinite()) return false;
  const VectorXd odds = log_odds(options, meaning, outputs);
  const Index none = outputs.size() - 1;
  if (!state.open) {
    for (Index c = 0; c < none; ++c) {
      if (state.sum[c] == 0.0) state.sum_start_s[c] = time;
      state.sum[c] = std::max(0.0, state.sum[c] + odds[c]);
    }
    if (state.sum.head(none).maxCoeff() == 0.0) {
      forget(state);
      return false;
    }
    vote(state, odds, odds);
    const Index best = largest_fault(state.sum);
    if (state.sum[best] >= options.threshold) open_at(state, state.sum_start_s[best], time);
    return false;
  }
  const double fault = odds.head(none).maxCoeff();
  state.healthy_sum = std::max(0.0, state.healthy_sum - fault);
  if (fault > 0.0) vote(state, odds, odds);
  if (state.healthy_sum == 0.0) state.open->end_s = time;
  return state.healthy_sum >= options.threshold;
}

bool step(const CriterionOptions& options, const OutputMeaning& meaning, double time, const VectorXd& outputs,
          CriterionState& state) {
  return options.kind == CriterionKind::consecutive ? consecutive_step(options, time, outputs, state)
                                                    : log_odds_step(options, meaning, time, outputs, state);
}

std::vector<SampleEpisode> all_episodes(const CriterionOptions& options, const OutputMeaning& meaning,
                                        const LabelledOutputs& run) {
  CriterionState state;
  auto episodes = apply_criterion(options, meaning, run.time, run.outputs, state);
  if (const auto last = open_episode(meaning, state)) episodes.push_back(*last);
  return episodes;
}

std::vector<CriterionOptions> settings_to_try(const CriterionOptions& start) {
  std::vector<CriterionOptions> settings;
  CriterionOptions next = start;
  for (int g : {1, 2, 3, 4, 5, 7, 10, 14, 20, 30, 45, 70, 100}) {
    next.g = g;
    next.threshold = 2.0 * g;
    settings.push_back(next);
  }
  return settings;
}

}  // namespace

const char* to_string(CriterionKind kind) {
  return kind == CriterionKind::consecutive ? "consecutive" : "log_odds";
}

std::vector<SampleEpisode> apply_criterion(const CriterionOptions& options, const OutputMeaning& meaning,
                                           const Eigen::Ref<const VectorXd>& time,
                                           const Eigen::Ref<const Eigen::MatrixXd>& outputs,
                                           CriterionState& state) {
  if (state.sum.size() != outputs.rows())
    state.sum = state.sum_start_s = state.votes = state.support = VectorXd::Zero(outputs.rows());
  std::vector<SampleEpisode> ended;
  for (Index i = 0; i < outputs.cols(); ++i) {
    if (!step(options, meaning, time[i], outputs.col(i), state)) continue;
    ended.push_back(finished(meaning, state, false));
    forget(state);
  }
  return ended;
}

std::optional<SampleEpisode> open_episode(const OutputMeaning& meaning, const CriterionState& state) {
  if (!state.open) return std::nullopt;
  return finished(meaning, state, true);
}

CriterionScore score_criterion(const CriterionOptions& options, const OutputMeaning& meaning,
                               std::span<const LabelledOutputs> runs) {
  CriterionScore score;
  score.options = options;
  std::vector<double> delays;
  for (const LabelledOutputs& run : runs) {
    if (run.time.size() == 0) continue;
    const bool faulty = run.fault.kind != FaultKind::none;
    bool found = false;
    for (const SampleEpisode& episode : all_episodes(options, meaning, run)) {
      if (!faulty || episode.alarm_s < run.onset_s) {
        ++score.false_alarms;
      } else if (!found) {
        found = true;
        ++score.detected;
        score.right += episode.label == run.fault;
        delays.push_back(episode.alarm_s - run.onset_s);
      }
    }
  }
  score.median_delay_s = upper_median(std::move(delays));
  return score;
}

CriterionSearch tune_criterion(const CriterionOptions& start, const OutputMeaning& meaning,
                               std::span<const LabelledOutputs> runs) {
  CriterionSearch search;
  int most = 0;
  for (const CriterionOptions& options : settings_to_try(start)) {
    search.tried.push_back(score_criterion(options, meaning, runs));
    most = std::max(most, search.tried.back().detected);
  }
  const auto key = [](const CriterionScore& score) {
    return std::tuple(score.false_alarms, -score.detected, score.median_delay_s);
  };
  std::size_t best = search.tried.size();
  for (std::size_t i = 0; i < search.tried.size(); ++i) {
    if (search.tried[i].detected < kFewestFound * most) continue;
    if (best == search.tried.size() || key(search.tried[i]) < key(search.tried[best])) best = i;
  }
  // The smallest setting with the fewest false alarms has no margin; take the next larger one if it loses
  // hardly any detection.
  const bool margin = best + 1 < search.tried.size() &&
                      search.tried[best + 1].detected >= kFreeMargin * search.tried[best].detected;
  search.best = search.tried[best + (margin ? 1 : 0)].options;
  return search;
}

}  // namespace faultline
