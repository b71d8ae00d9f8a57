// SPDX-License-Identifier: MIT
#include "apps/work/diagnosis_recording.hpp"

#include <memory>

#include "apps/work/diagnosis_events.hpp"
#include "formats/mcap/mcap_recording.hpp"
#include "formats/messages/own_topics.hpp"
#include "formats/provenance.hpp"
#include "lib/diagnose/curves/expected_joint.hpp"
#include "lib/diagnose/curves/required_torque.hpp"
#include "lib/diagnose/monitor/model_rate.hpp"
#include "lib/fault/label_text.hpp"
#include "lib/report/json.hpp"

namespace faultline {
namespace {

ComputedSignals signals_of(const char* topic, int joints, bool with_velocity) {
  const JointSignals empty(joints);
  return {topic, empty, with_velocity ? empty : JointSignals{}, empty};
}

/// Predictions and residuals, the latter in units of their healthy rms, those of torque in N m or N.
ComputedRows computed_rows(const Model& model, const Log& segment, const Residuals& residuals,
                           const RequiredTorque& torque) {
  ComputedRows computed;
  const int joints = residuals.joints();
  if (joints == 0) return computed;
  const bool measured = !segment.dq.empty();
  ComputedSignals predicted = signals_of(kPredictedTopic, joints, measured),
                  residual = signals_of(kResidualsTopic, joints, true);
  for (int i = 0; i < residuals.count(); ++i) {
    computed.row.push_back(static_cast<int>(residuals.row[i] - segment.first_row));
    for (int j = 0; j < joints; ++j) {
      const ExpectedJoint expected =
          expected_joint(model.residual.healthy, segment, computed.row.back(), residuals, i, j);
      predicted.position[j].push_back(expected.q);
      if (measured) predicted.velocity[j].push_back(expected.dq);
      predicted.effort[j].push_back(torque(j, computed.row.back()));
      residual.position[j].push_back(residuals.position(j, i));
      residual.velocity[j].push_back(residuals.velocity(j, i));
      residual.effort[j].push_back(residuals.torque(j, i));
    }
  }
  computed.signals = {std::move(predicted), std::move(residual)};
  return computed;
}

/// Returns the evidence of the most likely labels of a fault; names such as "torque_loss_2" are paths of a
/// plot.
NamedCurves evidence_of(const FaultFinding& fault) {
  NamedCurves curves;
  curves.topic = std::string(kEvidenceTopic) + "/fault_" + std::to_string(fault.id);
  curves.time = fault.trace.time;
  for (const EvidenceCurve& curve : fault.trace.curves) {
    curves.names.push_back(label_text(curve.label, "_"));
    curves.values.push_back(curve.ratio);
  }
  return curves;
}

}  // namespace

void write_recording(const std::string& path, LogSource& log, const Model& model,
                     const Diagnosis& diagnosis) {
  const auto recording = create_mcap_recording(path);
  std::unique_ptr<LogSource> kept;
  LogSource& judged = judged_rows(log, model, diagnosis.log.issues, kept);
  ResidualState state;
  for_each_with_required_torque(
      judged, model, diagnosis, [&](const Log& segment, const RequiredTorque& torque) {
        const Residuals residuals = compute_residuals(model.residual, segment, state);
        recording->write(segment, computed_rows(model, segment, residuals, torque));
      });
  for (const FaultFinding& fault : diagnosis.faults)
    if (!fault.trace.time.empty()) recording->write(evidence_of(fault));
  const std::string report = render_json(diagnosis);
  recording->note_events(events_of_diagnosis(report, path));
  recording->note("faultline/diagnosis", report);
  const std::string provenance = provenance_of(log);
  if (!provenance.empty()) recording->note_provenance(provenance);
  recording->commit();
}

}  // namespace faultline
