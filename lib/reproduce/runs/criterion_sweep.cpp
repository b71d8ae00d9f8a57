// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/criterion_sweep.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

using Eigen::Index;

constexpr double kLeastOutput = 1e-4;  // as in apply_criterion

/// A maximal run of samples whose largest output is the same.
struct OutputRun {
  int output = 0;
  Index start = 0;
  int length = 0;
};

/// ThresholdSums of one threshold over the samples.
class ThresholdSums {
 public:
  ThresholdSums(double threshold, Index faults)
      : threshold_(threshold), sum_(Eigen::VectorXd::Zero(faults)) {}

  void take(double time_s, const Eigen::Ref<const Eigen::VectorXd>& odds, const OutputMeaning& meaning) {
    if (open_) {
      healthy_ = std::max(0.0, healthy_ - odds.maxCoeff());
      if (healthy_ < threshold_) return;
      open_ = false;
      healthy_ = 0.0;
      sum_.setZero();
      return;
    }
    Index best = 0;
    for (Index c = 0; c < sum_.size(); ++c) {
      sum_[c] = std::max(0.0, sum_[c] + odds[c]);
      if (sum_[c] > sum_[best]) best = c;
    }
    if (sum_[best] < threshold_) return;
    open_ = true;
    alarms.push_back({time_s, meaning.classes[best]});
  }

  Alarms alarms;

 private:
  double threshold_;
  Eigen::VectorXd sum_;
  double healthy_ = 0.0;
  bool open_ = false;
};

std::vector<OutputRun> runs_of(const Eigen::MatrixXd& outputs) {
  std::vector<OutputRun> runs;
  for (Index i = 0; i < outputs.cols(); ++i) {
    Index largest = -1;
    if (outputs.col(i).allFinite()) outputs.col(i).maxCoeff(&largest);
    if (runs.empty() || largest != runs.back().output) runs.push_back({static_cast<int>(largest), i, 0});
    ++runs.back().length;
  }
  return runs;
}

}  // namespace

std::vector<Alarms> sweep_consecutive(const OutputMeaning& meaning, const Eigen::VectorXd& time,
                                      const Eigen::MatrixXd& outputs, int most_g) {
  const int none = static_cast<int>(outputs.rows()) - 1;
  std::vector<Alarms> alarms(most_g);
  std::vector<char> open(most_g, 0);
  for (const OutputRun& run : runs_of(outputs)) {
    if (run.output < 0) continue;
    for (int g = 1; g <= std::min(run.length, most_g); ++g) {
      if (run.output != none && !open[g - 1])
        alarms[g - 1].push_back({time[run.start + g - 1], meaning.classes[run.output]});
      open[g - 1] = run.output != none;
    }
  }
  return alarms;
}

Eigen::MatrixXd sample_log_odds(const OutputMeaning& meaning, const Eigen::MatrixXd& outputs,
                                double sample_cap) {
  const Index none = outputs.rows() - 1;
  const Eigen::ArrayXXd logs = outputs.array().max(kLeastOutput).unaryExpr(&elementary::log);
  Eigen::ArrayXXd odds = logs.topRows(none).rowwise() - logs.row(none);
  if (meaning.prior.size() == outputs.rows())
    odds.colwise() -= (meaning.prior.head(none).array() / meaning.prior[none]).unaryExpr(&elementary::log);
  return odds.max(-sample_cap).min(sample_cap).matrix();
}

std::vector<Alarms> sweep_log_odds(const OutputMeaning& meaning, const Eigen::VectorXd& time,
                                   const Eigen::MatrixXd& outputs, std::span<const double> thresholds,
                                   double sample_cap) {
  const Eigen::MatrixXd odds = sample_log_odds(meaning, outputs, sample_cap);
  std::vector<ThresholdSums> sums;
  for (const double threshold : thresholds) sums.emplace_back(threshold, odds.rows());
  for (Index i = 0; i < odds.cols(); ++i) {
    if (!outputs.col(i).allFinite()) continue;
    for (ThresholdSums& sum : sums) sum.take(time[i], odds.col(i), meaning);
  }
  std::vector<Alarms> alarms;
  for (ThresholdSums& sum : sums) alarms.push_back(std::move(sum.alarms));
  return alarms;
}

int choose_setting(std::span<const AlarmScore> tuning) {
  constexpr double kMostMissed = 0.1, kMarginCost = 0.01;
  double most = 0.0;
  for (const AlarmScore& score : tuning) most = std::max(most, score.detected());
  int best = -1;
  for (int i = 0; i < static_cast<int>(tuning.size()); ++i) {
    if (tuning[i].detected() < (1.0 - kMostMissed) * most) continue;
    if (best < 0 || tuning[i].false_alarms < tuning[best].false_alarms) best = i;
  }
  const bool margin = best + 1 < static_cast<int>(tuning.size()) &&
                      tuning[best + 1].detected() >= (1.0 - kMarginCost) * tuning[best].detected();
  return margin ? best + 1 : std::max(best, 0);
}

}  // namespace faultline
