// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/fault/fault_kind.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// A signal over equal bins of time: of each bin its two extremes, in the order in which they occurred, so
/// that no peak is lost and a line through them looks like the signal. NaN where nothing was measured; empty
/// when the log does not have the signal.
struct Envelope {
  std::vector<float> values;  ///< two a bin
};

struct JointCurves {
  Envelope q,
      q_predicted;  ///< rad or m; predicted one step ahead by the residual generator, or its reference
  Envelope dq, dq_predicted;    ///< rad/s or m/s
  Envelope tau, tau_required;   ///< N m or N; tau_required: of the healthy robot for the measured motion
  std::vector<float> residual;  ///< one a bin: largest magnitude of the normalised velocity residual
};

/// Outputs of the paper's networks for one label, sample by sample: near 1 if the label applies.
struct NetworkCurves {
  FaultLabel label;
  Envelope mlp, rbfn;
};

/// A stretch of a run.
struct CurveWindow {
  int fault_id = 0;  ///< around this fault; 0: the whole log
  double start_s = 0.0, end_s = 0.0;
  int bins = 0;
  std::vector<JointCurves> joints;
  std::vector<NetworkCurves> networks;  ///< only around a fault

  /// Middle of the part of the window that value `i` of `count` stands for, s.
  double time_s(std::size_t i, std::size_t count) const {
    return start_s + (end_s - start_s) * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
  }
};

/// The course of a run, in a number of bins that does not grow with its length.
struct RunCurves {
  CurveWindow whole;
  std::vector<CurveWindow> details;      ///< around the first faults, by onset
  std::vector<double> healthy_residual;  ///< largest normalised velocity residual when healthy, a joint each
  std::vector<char> turns;               ///< 1 for a revolute joint
  bool by_reference = false;             ///< the predicted curves are references: the log was only tracked
  TorqueMeaning torque = TorqueMeaning::measured;  ///< what `tau` is
  double alarm_ratio = 0.0;                        ///< least log likelihood ratio that raises an alarm

  bool empty() const { return whole.bins == 0; }
};

}  // namespace faultline
