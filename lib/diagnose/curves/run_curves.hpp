// SPDX-License-Identifier: MIT
#pragma once

#include "lib/diagnose/curves/curves.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"

namespace faultline {

struct RunCurvesOptions {
  int whole_bins = 2000;     ///< of the whole log, at most
  int detail_bins = 1200;    ///< around a fault, at most
  int all_details = 8000;    ///< bins of all faults together, for a robot of four joints
  int most_details = 12;     ///< faults that are shown in detail
  double lead_s = 1.5;       ///< shown before the onset, at least
  double tail_s = 3.0;       ///< shown after the alarm, at least
  double lead_samples = 40;  ///< likewise
  double tail_samples = 80;
};

/// Returns the curves of a diagnosed log, by a second pass over it from its first row. Memory does not grow
/// with the log, and the result does not depend on segment borders. Empty for a log without duration.
RunCurves run_curves(LogSource& log, const Model& model, const Diagnosis& diagnosis,
                     const RunCurvesOptions& options = {});

}  // namespace faultline
