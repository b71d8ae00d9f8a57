// SPDX-License-Identifier: MIT
#pragma once

#include "lib/diagnose/diagnose_options.hpp"
#include "lib/diagnose/monitor/monitored_log.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Main loop of the program: leads every segment of a log through the residuals of the regenerated fault-free
/// motion and on to the regression, or to the networks over single samples. Memory does not grow with the
/// log, and the result does not depend on segment borders. Throws Error(input) when the log has other joints
/// than the model's robot, or neither torque nor references that the model can judge.
MonitoredLog monitor(LogSource& log, const Model& model, const DiagnoseOptions& options = {});

/// Monitors a simulated log whose fault is known to last from `onset_s` to `end_s`: onset and end are not
/// searched (explain_at()). The result has at most one episode, and no facts of the log.
MonitoredLog monitor_at(LogSource& log, const Model& model, double onset_s, double end_s);

/// Reads a log once that cannot be judged because of its rate or clock, and returns its facts alone.
MonitoredLog read_unjudged(LogSource& log, const Model& model);

}  // namespace faultline
