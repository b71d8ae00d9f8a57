// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/log/log.hpp"
#include "lib/residual/residual_generator.hpp"
#include "lib/residual/transitions.hpp"

namespace faultline {

/// Measured minus predicted, one column a prediction; joints x predictions. A prediction belongs to its later
/// row.
struct Residuals {
  std::vector<std::int64_t> row;  ///< counted from the first row of the log
  Eigen::VectorXd time;           ///< s
  Eigen::MatrixXd position;       ///< in units of the healthy rms, so that about 1 is healthy
  Eigen::MatrixXd velocity;       ///< likewise
  Eigen::MatrixXd torque;  ///< M(q) r / dt with r the velocity residual in rad/s or m/s: N m or N. A joint
                           ///< that swings freely shows minus its torque on its own axis (docs/residual.md)
  Eigen::MatrixXd tau;     ///< mean torque over the step as logged, N m or N
  Eigen::MatrixXd ratio;   ///< torque * tau / (tau^2 + eps^2): -1 for a free joint, 0 for a healthy one;
                           ///< eps is three times the healthy rms of `torque`

  int joints() const { return static_cast<int>(velocity.rows()); }
  int count() const { return static_cast<int>(row.size()); }
};

/// Residuals::ratio of torque-space residuals and torques, joints x samples; `torque_rms` is that of healthy
/// residuals.
Eigen::MatrixXd ratio_to_torque(const Eigen::MatrixXd& torque, const Eigen::MatrixXd& tau,
                                const Eigen::VectorXd& torque_rms);

using ResidualState = TransitionState;

/// Computes the residuals of all predictions that end in `segment`. Segments of one log are passed in order
/// with the same state; the result does not depend on their borders. Rows with missing numbers, and pairs
/// across a gap, give NaN. The velocities of a log without any are derived from its positions; a log without
/// torque has no residuals. Throws Error(input) when the log has other joints.
Residuals compute_residuals(const ResidualGenerator& generator, const Log& segment, ResidualState& state);
/// Returns the transitions that compute_residuals() uses, for a log that has torque.
Transitions log_transitions(const ResidualGenerator& generator, const Log& segment, ResidualState& state);
Residuals residuals_of(const ResidualGenerator& generator, const Transitions& transitions);

/// The residual of one joint over some time: measured minus regenerated fault-free motion (the one-step
/// prediction of the MLP), normalised by its healthy rms, so that about 1 is healthy. NaN when no residual
/// could be computed.
struct JointResidual {
  Joint joint{};
  double velocity_rms = std::numeric_limits<double>::quiet_NaN();
  double velocity_peak = std::numeric_limits<double>::quiet_NaN();  ///< largest magnitude
  double velocity_peak_s = std::numeric_limits<double>::quiet_NaN();
  double position_rms = std::numeric_limits<double>::quiet_NaN();
};

/// Sums residuals of a log, or of an interval of it, as they stream by.
class ResidualSummary {
 public:
  /// Counts predictions with from_s <= time <= to_s.
  explicit ResidualSummary(double from_s = -std::numeric_limits<double>::infinity(),
                           double to_s = std::numeric_limits<double>::infinity())
      : from_s_(from_s), to_s_(to_s) {}

  void add(const Residuals& residuals);
  /// Returns the summary so far, one entry a joint.
  std::vector<JointResidual> joints() const;

 private:
  struct Sums {
    std::int64_t count = 0;  ///< predictions without missing numbers
    double velocity2 = 0.0, position2 = 0.0;
    double velocity_peak = 0.0, velocity_peak_s = 0.0;
  };

  double from_s_, to_s_;
  std::vector<Sums> sums_;
};

}  // namespace faultline
