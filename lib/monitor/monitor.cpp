// SPDX-License-Identifier: MIT
#include "lib/monitor/monitor.hpp"

#include "lib/evidence/slow_states.hpp"
#include "lib/monitor/evidence_monitor.hpp"
#include "lib/monitor/log_tally.hpp"
#include "lib/monitor/sample_monitor.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {

MonitoredLog monitor(LogSource& log, const Model& model, const DiagnoseOptions& options) {
  const bool by_samples = options.mode == ClassifyMode::samples;
  EvidenceMonitor evidence(model, survey_noise(log, model.motion));
  SampleMonitor samples(model.samples, options);
  LogTally tally;
  ResidualState state;
  ResidualSummary whole;
  for (Log segment; log.next(segment);) {
    tally.take(segment, log, model);
    Residuals residuals = compute_residuals(model.residual, segment, state);
    whole.add(residuals);
    if (by_samples)
      samples.take(residuals);
    else
      evidence.take(segment, std::move(residuals));
  }
  evidence.finish();
  samples.finish();
  return {log_facts(log, tally, model, evidence.rejected_alarms()),
          whole.joints(),
          evidence.episodes(),
          samples.alarms(),
          evidence.largest_ratio(),
          evidence.slow_estimates(),
          evidence.slow_faults()};
}

}  // namespace faultline
