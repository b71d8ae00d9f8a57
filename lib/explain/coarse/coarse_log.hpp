// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "lib/balance/one_step/innovations.hpp"
#include "lib/balance/one_step/one_step_model.hpp"
#include "lib/explain/log_fit.hpp"

namespace faultline {

/// Values about which a round of judge_coarse() was linearised, and its steps.
struct CoarseSteps {
  Eigen::VectorXd day, size;  ///< `size` empty: not known
  Trajectory about;
  LinearSteps steps;
  double begin_s = 1e300, end_s = 1e300;  ///< times of the fault in them
};

/// A log explained at a coarse rate: the result of the filter and the regression. The residuals `left` are
/// whitened innovations: those of q, then of dq, of each joint, sample after sample.
struct CoarseExplanation : Explanation {
  double onset_step_s = 0.0;  ///< by which the onset should move; only with CoarseJudging::move_onset
  Eigen::MatrixXd variance;   ///< 2 joints x samples: of each innovation; NaN without a measurement
  Eigen::MatrixXd log_ratio;  ///< ln of `variance` over that of the healthy robot; 0 without it
  /// (2 joints * samples) x effects: whitened columns of the effects of the day. Only for the healthy robot.
  Eigen::MatrixXd day_column;
  std::shared_ptr<const CoarseSteps> steps{};  ///< of the round that gave this explanation
};

/// One log and one model at a coarse rate: the common part of all hypotheses.
struct CoarseLog {
  UniformLog log;
  const OneStepModel* model = nullptr;
  Eigen::VectorXd numbers;    ///< of the healthy robot
  Eigen::MatrixXd day;        ///< directions of the day's effects in them
  Trajectory read;            ///< measured trajectory
  Trajectory about;           ///< smoothed, with a large uncertainty of every torque
  int settled = 0;            ///< samples up to which smoothing converges: after them the robot runs away,
                              ///< or its measurements contradict each other
  LinearSteps healthy_steps;  ///< about `about`
  Eigen::MatrixXd variance;   ///< of the measurements
  Eigen::MatrixXd force_std;  ///< joints x intervals
  Eigen::MatrixXd stop;       ///< joints x intervals: 1 while an end stop holds the joint
  Eigen::MatrixXd keep;  ///< 2 joints x samples: 0 while an end stop holds the joint: the measurement has no
                         ///< weight in any hypothesis
  CoarseExplanation healthy;

  int joints() const { return model->joints(); }
  int samples() const { return log.rows(); }
  double period_s() const { return log.period_s; }
  double time_s(int k) const { return log.time_s(k); }
  double end_s() const { return log.time_s(samples() - 1); }
  int first_onset() const;  ///< first sample at which an onset is searched
};

/// Prepares a log, up to the first interval through which the robot cannot be integrated. Empty if too few
/// samples remain, or if the integration diverges. The model must outlive the result.
std::optional<CoarseLog> followed_log(UniformLog log, const OneStepModel& model);

/// Prepares the part of the log up to which smoothing converges; empty if too few samples remain.
std::optional<CoarseLog> settled_part(const CoarseLog& log);

/// Returns whether repeated codes of a position are evidence: in healthy logs its noise makes them rare.
bool repeats_are_evidence(const OneStepModel& model, int j);

}  // namespace faultline
