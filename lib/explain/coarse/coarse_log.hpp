// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "lib/balance/one_step/innovations.hpp"
#include "lib/balance/one_step/one_step_model.hpp"

namespace faultline {

/// What a round of a judgement was linear about, and the steps that it gave.
struct CoarseSteps {
  Eigen::VectorXd day, size;  ///< `size` empty: not known
  Trajectory about;
  LinearSteps steps;
  double begin_s = 1e300, end_s = 1e300;  ///< of the fault in them
};

/// A log explained at a coarse rate, as far as it goes on: what the filter and the regression leave of it.
struct CoarseExplanation {
  double log_likelihood = 0.0;      ///< marginal, up to what all hypotheses of the log share
  Eigen::VectorXd day;              ///< effects of the day, see OneStepModel::day_variance
  Eigen::VectorXd size;             ///< of the hypothesis
  Eigen::MatrixXd size_covariance;  ///< of the sizes, by readings and prior
  double onset_step_s = 0.0;        ///< by which the onset should move; only where it was asked for
  Eigen::MatrixXd left;             ///< 2 joints x samples: innovations left over, in standard deviations
  Eigen::MatrixXd variance;         ///< of each innovation; NaN where there was no reading
  Eigen::MatrixXd log_ratio;  ///< ln of `variance` over that of the healthy robot; 0 where there is none
  /// (2 joints * samples) x effects: what the effects of the day take away from the innovations. Only of the
  /// healthy robot.
  Eigen::MatrixXd day_column;
  Trajectory about;                            ///< smoothed
  std::shared_ptr<const CoarseSteps> steps{};  ///< of the round that this is from

  double mean_square() const { return left.squaredNorm() / static_cast<double>(left.size()); }
};

/// One log against one model at a coarse rate: what all hypotheses share.
struct CoarseLog {
  UniformLog log;
  const OneStepModel* model = nullptr;
  Eigen::VectorXd numbers;    ///< of the healthy robot
  Eigen::MatrixXd day;        ///< directions of the day's effects in them
  Trajectory read;            ///< what was measured
  Trajectory about;           ///< smoothed, with much doubt about every torque
  int settled = 0;            ///< samples up to which smoothing converges: behind them the robot runs away,
                              ///< or its readings contradict each other
  LinearSteps healthy_steps;  ///< about it
  Eigen::MatrixXd variance;   ///< of the readings
  Eigen::MatrixXd force_std;  ///< joints x intervals
  Eigen::MatrixXd stop;       ///< joints x intervals: 1 where an end stop holds the joint
  Eigen::MatrixXd keep;  ///< 2 joints x samples: 0 where an end stop holds the joint: the reading counts for
                         ///< no hypothesis
  CoarseExplanation healthy;

  int joints() const { return model->joints(); }
  int samples() const { return log.rows(); }
  double period_s() const { return log.period_s; }
  double time_s(int k) const { return log.time_s(k); }
  double end_s() const { return log.time_s(samples() - 1); }
  int first_onset() const;  ///< sample before which no onset is looked for
};

/// A robot that runs away so fast that it cannot be integrated is followed up to there; nothing where too few
/// rows are left to be explained. The model must outlive it.
std::optional<CoarseLog> followed_log(UniformLog log, const OneStepModel& model);

/// The part of the log up to which smoothing converges; nothing where too few rows are left.
std::optional<CoarseLog> settled_part(const CoarseLog& log);

/// Whether repeated codes of a position say anything: in healthy logs it hardly repeats, for its noise.
bool repeats_tell(const OneStepModel& model, int joint);

}  // namespace faultline
