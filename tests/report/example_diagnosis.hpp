// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "lib/diagnose/verdict.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {

inline Diagnosis healthy_diagnosis() {
  Diagnosis d;
  d.log.path = "bench/healthy_4.csv";
  d.log.sha256 = std::string(64, 'a');
  d.log.format = "csv";
  d.log.rows_read = 10000;
  d.log.rows_used = 10000;
  d.log.start_s = 0.0;
  d.log.end_s = 9.999;
  d.log.sample_period_s = 0.001;
  d.log.joints = 3;
  d.model = {"bench", std::string(64, 'b'), std::string(64, 'c')};
  d.program_version = "0.1.0";
  d.verdict = Verdict::healthy;
  d.score = {{FaultKind::payload_change, 2_joint}, 3.75, 12.5, 100.0};
  for (int number = 1; number <= 3; ++number)
    d.residuals.push_back({.joint = Joint::numbered(number),
                           .velocity_rms = 0.97 + 0.01 * number,
                           .velocity_peak = 3.5 + number,
                           .velocity_peak_s = 1.25 * number,
                           .position_rms = 1.0});
  d.condition = {{"friction_1", "friction of joint 1", 1_joint, 12.25, {11.0, 13.5}, 30.0, "%"},
                 {"torque_offset_1", "torque offset of joint 1", 1_joint, 0.5, {-2.0, 3.0}, 1.0, "N m"},
                 {"tip_mass", "mass at the tip", Joint(), -0.125, {-0.15, -0.1}, 0.05, "kg"}};
  return d;
}

/// One confirmed in the field, and a simulated one that is more like it.
inline std::vector<Precedent> example_precedents() {
  const FaultLabel locked{FaultKind::locked, 2_joint};
  Precedent field{
      .case_id = 31, .label = locked, .similarity = 0.71, .what_was_done = "changed the brake relay"};
  field.origin = CaseOrigin::field;
  field.origin_text = "confirmed in the field by A. Weber on 2026-03-02, robot bench 7, log night.csv";
  field.log = "night.csv";
  field.robot = "bench 7";
  field.person = "A. Weber";
  field.date = "2026-03-02";
  field.alike = {{"mlp residual 2", "MLP residual of joint 2", "times healthy", 12.5, 13.25, 0.125}};
  field.unlike = {{"duration", "time from onset until it was named", "s", 0.5, 2.25, 2.5}};
  Precedent simulated{.case_id = 12, .label = locked, .similarity = 0.83};
  simulated.origin_text = "simulated with the robot's model";
  simulated.alike = field.alike;
  return {field, simulated};
}

inline FaultFinding locked_joint() {
  FaultFinding f;
  f.label = {FaultKind::locked, 2_joint};
  f.onset_s = 4.21;
  f.alarm_s = 4.217;
  f.end_s = 9.999;
  f.confidence = 0.965;
  f.mlp = {f.label, 0.98};
  f.rbfn = {f.label, 0.95};
  f.decided_by = DecidedBy::agreement;
  f.precedents = example_precedents();
  f.could_also_be = {
      {{FaultKind::stuck_encoder, 2_joint},
       "both show a position that does not change; only exactly repeated encoder codes and the "
       "motion of the other joints distinguish them"}};
  f.evidence = {{"log_likelihood_ratio", 312.4, "", "log likelihood of this fault over none"},
                {"residual_peak", 41.5, "healthy rms", "largest velocity residual of joint 2"}};
  f.next_check = next_check_for(f.label);
  f.episode = {312.4, {{"a", 1.0}, {"b", std::numeric_limits<double>::quiet_NaN()}, {"noise", -0.5}}};
  return f;
}

/// A log with one locked joint, an imperfection and a limit.
inline Diagnosis faulty_diagnosis() {
  Diagnosis d = healthy_diagnosis();
  d.log.path = "bench/locked_2.csv";
  d.log.rows_used = 9998;
  d.log.issues.add({.code = "time_backward",
                    .channel = "t",
                    .severity = Severity::warning,
                    .message = "time runs back from 0.016 s to 0.015 s; the rows were left out",
                    .first_row = 17,
                    .first_time_s = 0.015,
                    .count = 2,
                    .rows_dropped = 2});
  d.faults = {locked_joint()};
  d.score = {{FaultKind::locked, 2_joint}, 4.21, 312.5, 100.0};
  d.residuals[1].velocity_rms = 12.5;
  d.residuals[1].velocity_peak = 41.5;
  d.cannot_see = {"the torque is the commanded one, so a fault inside the drive shows only in the motion"};
  d.faults = numbered_by_onset(std::move(d.faults));
  d.verdict = Verdict::faulty;
  return d;
}

/// Two faults, one of no joint and undecided by the networks, with texts that try to break each format.
inline Diagnosis hostile_diagnosis() {
  Diagnosis d = faulty_diagnosis();
  d.log.path = "a,\"b\"\n<c>&'\x1b[31m\xff.csv";
  FaultFinding f;
  f.label = {FaultKind::unknown, Joint()};
  f.onset_s = 2.0;
  f.alarm_s = 2.5;
  f.mlp = {{FaultKind::collision, 1_joint}, 0.55};
  f.rbfn = {{FaultKind::payload_change, Joint()}, 0.4};
  f.decided_by = DecidedBy::cases;
  f.precedents = {{7, {FaultKind::collision, 1_joint}, 0.41, "]]> \"done\"\x07\nnext line"}};
  f.precedents[0].origin_text = "confirmed in the field by <b>|\x1b[31m\nA. & B.</b>";
  f.precedents[0].alike = {{"a", "<i>|x|\x07", "\"m\"", 1.0, 2.0, 0.5}};
  f.could_also_be = {{{FaultKind::collision, 1_joint}, "named by the MLP"}};
  f.next_check = next_check_for(f.label);
  d.faults.push_back(f);
  d.faults = numbered_by_onset(std::move(d.faults));
  d.verdict = Verdict::faulty;
  return d;
}

inline Diagnosis inconclusive_diagnosis() {
  Diagnosis d = healthy_diagnosis();
  d.log.path = "bench/short.csv";
  d.log.rows_read = d.log.rows_used = 3;
  d.log.end_s = 0.002;
  d.verdict = Verdict::inconclusive;
  d.verdict_reason = "3 rows are too few to judge; at least 20 are needed";
  d.residuals.clear();
  d.score = {};
  return d;
}

}  // namespace faultline
