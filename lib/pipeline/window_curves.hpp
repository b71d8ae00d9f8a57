// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/classify/sample_classifier.hpp"
#include "lib/diagnosis/envelope_builder.hpp"
#include "lib/log/log.hpp"
#include "lib/pipeline/model.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {

/// Gathers the curves of one stretch of a log as segments stream by, in order; where segments end changes
/// nothing.
class WindowCurves {
 public:
  /// `labels`: what the networks are asked about in this window; none for a window that does not show them.
  WindowCurves(const CurveWindow& window, const Model& model, const std::vector<FaultLabel>& labels);

  /// The rows of `segment` and the predictions that end in it.
  void take(const Log& segment, const Residuals& residuals);
  CurveWindow curves() const;

 private:
  struct Joint {
    EnvelopeBuilder q, q_foretold, dq, dq_foretold, tau, tau_needed, residual;
  };
  struct Network {
    FaultLabel label;
    Eigen::Index output;
    EnvelopeBuilder mlp, rbfn;
  };

  int bin_of(double time_s) const;
  void take_rows(const Log& segment);
  void take_predictions(const Log& segment, const Residuals& residuals);
  void take_prediction(const Log& segment, int row, const Residuals& residuals, int i, int bin);
  void take_outputs(const Residuals& residuals);

  CurveWindow window_;
  const Model& model_;
  double bins_per_s_;
  double held_s_;      ///< a prediction stands for the rows up to the next one
  int last_bin_ = -1;  ///< of the last prediction
  double last_s_ = 0.0;
  std::vector<Joint> joints_;
  std::vector<Network> networks_;
};

}  // namespace faultline
