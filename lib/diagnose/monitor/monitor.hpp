// SPDX-License-Identifier: MIT
#pragma once

#include "lib/diagnose/diagnose_options.hpp"
#include "lib/diagnose/monitor/monitored_log.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// The loop of the whole program: every segment goes through the residuals of the regenerated fault-free
/// motion and on to the regression, or to the networks over single samples. Memory does not grow with the
/// log, and where segments end changes nothing. Throws Error(input) when the log has other joints than the
/// model's robot, or no torque.
MonitoredLog monitor(LogSource& log, const Model& model, const DiagnoseOptions& options = {});

/// The same of a simulated log whose fault is known to last from `onset_s` to `end_s`: nothing is searched
/// (explain_at()), and of the log's facts none are told.
MonitoredLog monitor_at(LogSource& log, const Model& model, double onset_s, double end_s);

/// What is known of a log whose rate or clock lets nothing of it be judged: read once, with no finding.
MonitoredLog read_unjudged(LogSource& log, const Model& model);

}  // namespace faultline
