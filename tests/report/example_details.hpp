// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "lib/report/html/html_report.hpp"
#include "tests/report/example_diagnosis.hpp"

namespace faultline {

inline Envelope example_envelope(int bins, double phase) {
  Envelope envelope;
  for (int i = 0; i < 2 * bins; ++i)
    envelope.values.push_back(static_cast<float>(std::sin(0.05 * i + phase) + 0.02 * (i % 2)));
  return envelope;
}

inline CurveWindow example_window(int fault_id, double start_s, double end_s, int bins, int joints = 3) {
  CurveWindow window{fault_id, start_s, end_s, bins, {}, {}};
  for (int j = 0; j < joints; ++j) {
    JointCurves joint{example_envelope(bins, j),
                      example_envelope(bins, j + 0.1),
                      example_envelope(bins, j + 0.5),
                      example_envelope(bins, j + 0.6),
                      example_envelope(bins, j + 1.0),
                      example_envelope(bins, j + 1.1),
                      std::vector<float>(static_cast<std::size_t>(bins), 0.8f)};
    joint.residual[static_cast<std::size_t>(bins) / 2] = 40.0f;
    window.joints.push_back(joint);
  }
  return window;
}

/// Curves and tables for faulty_diagnosis() and its like: a run of 10 s, a detail around each fault.
inline ReportDetails example_details(const Diagnosis& d) {
  ReportDetails details;
  RunCurves& curves = details.curves;
  curves.whole = example_window(0, d.log.start_s, d.log.end_s, 500);
  for (const FaultFinding& fault : d.faults) {
    CurveWindow detail =
        example_window(fault.id, std::max(fault.onset_s - 1.0, d.log.start_s), fault.onset_s + 2.0, 300);
    detail.networks = {{fault.label, example_envelope(300, 0.0), example_envelope(300, 0.2)},
                       {{FaultKind::none, Joint()}, example_envelope(300, 1.0), example_envelope(300, 1.2)}};
    curves.details.push_back(detail);
  }
  curves.healthy_residual = {5.0, 6.0, 4.0};
  curves.turns = {1, 1, 0};
  curves.alarm_ratio = 18.0;
  details.model = {{"Identified parameters (converged)",
                    {"parameter", "value", "95 % interval", "unit", "remark"},
                    {{"m1", "1.0012", "0.9981 to 1.0043", "kg", ""}}}};
  details.provenance = {{"Options", {}, {{"--classify", "evidence"}}}};
  return details;
}

/// faulty_diagnosis() with the evidence of its fault as it grew.
inline Diagnosis traced_diagnosis() {
  Diagnosis d = faulty_diagnosis();
  EvidenceTrace& trace = d.faults[0].trace;
  EvidenceCurve locked{{FaultKind::locked, 2_joint}, {}}, stuck{{FaultKind::stuck_encoder, 2_joint}, {}};
  for (int i = 0; i < 100; ++i) {
    trace.time.push_back(4.21 + 0.005 * i);
    locked.ratio.push_back(3.0 * i);
    stuck.ratio.push_back(i < 10 ? std::numeric_limits<double>::quiet_NaN() : 2.0 * i - 20.0);
  }
  trace.curves = {locked, stuck};
  return d;
}

}  // namespace faultline
