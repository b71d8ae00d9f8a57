// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include "lib/diagnose/curves/run_curves.hpp"

namespace faultline {

/// {"whole": window, "faults": [window, ...], "healthy_residual": [...], "by_reference": bool,
/// "alarm_ratio": x}; a window is {"fault_id", "start_s", "end_s", "t", "t_residual", "q1", "q1_predicted",
/// ..., "residual1", ...} with an array a signal. Signals that the log does not have are left out.
pybind11::dict curve_arrays(const RunCurves& curves);

}  // namespace faultline
