// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/classify/sample_classifier.hpp"
#include "lib/diagnose/curves/curves.hpp"
#include "lib/diagnose/curves/required_torque.hpp"
#include "lib/log/log.hpp"
#include "lib/model/model.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {

/// The state that was predicted one step ahead for the healthy robot, at the row where the prediction ends.
struct ExpectedJoint {
  double q = 0.0, dq = 0.0;  ///< rad or m and per s; dq is NaN without measured velocities
};

/// Returns prediction `i` of `residuals` for joint `j` (from 0); it ends at row `row` of the segment.
ExpectedJoint expected_joint(const HealthyResiduals& healthy, const Log& segment, int row,
                             const Residuals& residuals, int i, int j);

/// Gathers the curves of one stretch of a log as segments stream by, in order; the result does not depend on
/// segment borders.
class WindowCurves {
 public:
  /// `labels`: those whose network outputs the window shows; empty for a window without outputs.
  WindowCurves(const CurveWindow& window, const Model& model, const std::vector<FaultLabel>& labels);

  /// Adds the rows of `segment`, the predictions that end in it, and the torque required at its rows, which
  /// may be empty.
  void take(const Log& segment, const Residuals& residuals, const RequiredTorque& torque);
  CurveWindow curves() const;

 private:
  struct JointColumns {
    EnvelopeBuilder q, q_predicted, dq, dq_predicted, tau, tau_required, residual;
  };
  struct Network {
    FaultLabel label;
    Eigen::Index output;
    EnvelopeBuilder mlp, rbfn;
  };

  /// The last bin that predictions filled. A prediction also fills the empty bins since the one before it.
  struct Reached {
    int bin = -1;
    double time_s = 0.0;
  };

  int bin_of(double time_s) const;
  int first_bin_of(int bin, double time_s, const Reached& last) const;
  void take_row(const Log& segment, int row, int bin, const RequiredTorque& torque, bool by_reference);
  void take_predictions(const Log& segment, const Residuals& residuals);
  void take_prediction(const Log& segment, int row, const Residuals& residuals, int i, int bin);
  void take_outputs(const Residuals& residuals);

  CurveWindow window_;
  const Model& model_;
  double bins_per_s_;
  double held_s_;  ///< longest time between two predictions without a gap in the log
  Reached predicted_, classified_;
  std::vector<JointColumns> joints_;
  std::vector<Network> networks_;
};

}  // namespace faultline
