// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
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

/// Fills an Envelope from samples in the order of time.
class EnvelopeBuilder {
 public:
  explicit EnvelopeBuilder(int bins = 0) : bins_(static_cast<std::size_t>(bins)) {}

  /// Adds a sample to a bin. A value that is not finite was not measured: it leaves a gap.
  void add(int bin, double value) {
    Bin& b = bins_[static_cast<std::size_t>(bin)];
    const auto v = static_cast<float>(value);
    b.reached = true;
    if (!std::isfinite(v)) return;
    any_ = true;
    if (!(v >= b.low)) {
      if (std::isnan(b.low)) b.high = v;
      b.low = v;
      b.low_is_last = true;
    } else if (v > b.high) {
      b.high = v;
      b.low_is_last = false;
    }
  }

  /// Returns the envelope. A single bin that the samples of a jittering clock skip holds the value before it.
  Envelope envelope() const {
    Envelope out;
    if (!any_) return out;
    out.values.reserve(2 * bins_.size());
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      const Bin& b = bins_[i];
      const bool between = !b.reached && i > 0 && i + 1 < bins_.size() && bins_[i + 1].reached;
      const float held = between ? out.values.back() : b.low;
      out.values.push_back(between ? held : b.low_is_last ? b.high : b.low);
      out.values.push_back(between ? held : b.low_is_last ? b.low : b.high);
    }
    return out;
  }

 private:
  struct Bin {
    float low = std::numeric_limits<float>::quiet_NaN();
    float high = std::numeric_limits<float>::quiet_NaN();
    bool low_is_last = false;
    bool reached = false;
  };
  std::vector<Bin> bins_;
  bool any_ = false;
};

}  // namespace faultline
