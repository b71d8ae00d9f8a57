// SPDX-License-Identifier: MIT
#include "apps/work/learned_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "lib/core/outgoing/json_text.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/blind_spots.hpp"
#include "lib/fault/fault_kind.hpp"
#include "lib/identify/identification_json.hpp"
#include "lib/report/model_facts.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {
namespace {

std::string delay_text(double seconds) {
  return std::isfinite(seconds) ? fmt::format("{:.3f}", seconds) : "-";
}

std::string counts_text(const std::string& name, const ValidationRow& row) {
  const std::vector<std::string> counts = validation_counts(row);
  return fmt::format("{:<18} {:>5} {:>6} {:>6} {:>6} {:>8}", name, counts[0], counts[1], counts[2], counts[3],
                     counts[4]);
}

ValidationRow sum_of(const std::vector<ValidationRow>& rows) {
  ValidationRow all;
  for (const ValidationRow& row : rows) {
    all.runs += row.runs;
    all.detected += row.detected;
    all.right_joint += row.right_joint;
    all.right_kind_and_joint += row.right_kind_and_joint;
    all.right_or_named += row.right_or_named;
  }
  return all;
}

std::string validation_text(const Validation& validation) {
  std::string text = fmt::format("{:<18} {:>5} {:>6} {:>6} {:>6} {:>8} {:>10} {:>8}\n", "simulated fault",
                                 "runs", "found", "joint", "both", "or named", "delay/s", "p90/s");
  for (const ValidationRow& row : validation.rows)
    text += fmt::format("{} {:>10} {:>8}\n", counts_text(to_string(row.kind), row),
                        delay_text(row.median_delay_s), delay_text(row.p90_delay_s));
  text += counts_text("all", sum_of(validation.rows)) + "\n";
  text += fmt::format(
      "False alarms: {} in {:.2f} h of simulated healthy operation; alarms before the onset: {}.\n",
      validation.false_alarms, validation.healthy_hours, validation.early_alarms);
  if (std::isfinite(validation.confidence_error))
    text += fmt::format(
        "Confidences are calibrated: on average {:.2f} from the share of right decisions ({:.2f} before).\n",
        validation.confidence_error, validation.raw_confidence_error);
  return text;
}

/// Returns a table of the smallest detectable fault of each kind and joint.
std::string reach_table(const Model& model) {
  if (model.validation.reach.empty()) return "";
  std::string text =
      fmt::format("{:<18} {:>5} {:>9} {:>16} {:>10}\n", "fault", "joint", "found", "from", "delay/s");
  for (const Detectability& reach : model.validation.reach) {
    const bool is_hidden = std::isnan(reach.size) && describe(reach.label.kind).size_count > 0;
    const std::string size = is_hidden ? "none" : detectable_size_text(reach, model.robot.chain);
    text += fmt::format("{:<18} {:>5} {:>9} {:>16} {:>10}\n", to_string(reach.label.kind), reach.label.joint,
                        fmt::format("{} of {}", reach.found, reach.runs), size.empty() ? "-" : size,
                        delay_text(reach.median_delay_s));
  }
  return text;
}

/// Returns the evidence that a fault must exceed to be reported, and the kinds that need more than most.
std::string limits_text(const EvidenceLimits& limits, const std::vector<FaultLabel>& labels) {
  double least = std::numeric_limits<double>::infinity();
  for (const FaultLabel& label : labels) least = std::min(least, limits.of(label.kind));
  std::string text = fmt::format("A fault is reported from {:.0f} nats on", least);
  FaultKind last = FaultKind::none;
  for (const FaultLabel& label : labels) {
    if (label.kind != last && limits.of(label.kind) > least)
      text += fmt::format(", {} from {:.0f}", to_string(label.kind), limits.of(label.kind));
    last = label.kind;
  }
  return text +
         ": three times the evidence in healthy logs, each judged by a model of the others, and more than "
         "in simulated healthy runs.\n";
}

std::string relation_name(const SignalRelation& relation) {
  switch (relation.kind) {
    case RelationKind::actuator:
      return "commanded torque, for the measured one,";
    case RelationKind::control_law:
      return "control law, for the commanded torque,";
    case RelationKind::tracking:
      return relation.target == Quantity::q ? "reference, for the position," : "reference, for the velocity,";
  }
  return "";
}

const char* unit_of(const SignalRelation& relation, AxisKind axis) {
  if (relation.kind != RelationKind::tracking) return torque_unit(axis);
  return relation.target == Quantity::q ? position_unit(axis) : velocity_unit(axis);
}

/// Returns the accuracy of each signal relation and the deviation from which on it detects a fault.
std::string relations_text(const Model& model) {
  std::string text;
  for (const SignalRelation& relation : model.relations) {
    const int middle = static_cast<int>(relation.windows.size()) / 2;
    text += fmt::format(
        "Joint {}: the {} explains {:.2f} % of held-out logs; a deviation is detected from {:.3g} {} over "
        "{:g} s on.\n",
        relation.joint, relation_name(relation), 100.0 * relation.r2, allowed_mean(relation, middle),
        unit_of(relation, model.robot.chain.geometry[relation.joint.index()].kind),
        relation.windows[middle].window_s);
  }
  return text;
}

std::string parameter_text(const Identification& identification) {
  std::string text;
  for (const ParameterEstimate* p : listed_parameters(identification))
    if (p->identifiable)
      text += fmt::format("  {:<6} {:>11.5g} +- {:<8.2g} {}\n", p->name, p->value,
                          0.5 * (p->ci95[1] - p->ci95[0]), p->unit);
    else
      text += fmt::format("  {:<6} not determined: {}\n", p->name, p->why_not);
  return text;
}

std::string mechanics_text(const Learned& learned) {
  if (!learned.model.has_mechanics())
    return "\nThe logs have no torque: only whether each joint follows its reference is learned and "
           "judged.\n";
  return fmt::format("\nIdentified, with 95 % intervals ({}):\n{}", to_string(learned.identification.status),
                     parameter_text(learned.identification)) +
         fmt::format(
             "\nTested on simulated runs of the identified robot that were not used for training:\n{}",
             validation_text(learned.model.validation)) +
         "\nThe smallest fault whose evidence passes its limit when it begins in the middle of a log like "
         "the healthy ones (none: in a tenth of the logs a joint at rest or its noise hides it at any size), and "
         "how many of the simulated faults were found:\n" +
         reach_table(learned.model) + limits_text(learned.model.explain.limits, learned.model.labels);
}

/// Returns the warnings about the logs and the model.
std::string warnings_text(const Learned& learned) {
  std::string text;
  for (const Issue& issue : learned.identification.issues.all())
    if (issue.severity != Severity::note)
      text += fmt::format("Warning: {}{}\n", issue.message,
                          issue.count > 1 ? fmt::format(" ({} times)", issue.count) : "");
  for (const std::string& doubt : learned.model.doubts) text += fmt::format("Doubtful: {}\n", doubt);
  if (!learned.model.doubts.empty()) text += "Each diagnosis with this model reports this.\n";
  return text.empty() ? text : "\n" + text;
}

nlohmann::ordered_json carried_json(const CarriedCases& carried) {
  return {{"carried", carried.carried},
          {"recomputed", carried.recomputed},
          {"old_features", carried.old_features},
          {"renumbered", carried.renumbered},
          {"replaced", carried.replaced}};
}

std::string logs_text(const std::vector<ModelSource>& sources) {
  const auto left_out = std::count_if(sources.begin(), sources.end(),
                                      [](const ModelSource& source) { return source.fault == kLeftOut; });
  return counted(std::ssize(sources) - left_out, "log") +
         (left_out > 0 ? fmt::format(" ({} left out)", left_out) : std::string());
}

}  // namespace

std::string learned_text(const Learned& learned, const std::string& model_path,
                         const std::string& case_base_path) {
  return fmt::format("Learned \"{}\" from {} at {:.4g} Hz.\n", shortened(learned.model.name, kLongestName),
                     logs_text(learned.model.sources), 1.0 / learned.model.sample_period_s) +
         mechanics_text(learned) + relations_text(learned.model) + warnings_text(learned) +
         fmt::format("\nModel: {}\nCase base: {} ({} cases)\n", model_path, case_base_path,
                     learned.cases.cases().size());
}

std::string learned_json(const Learned& learned, const std::optional<CarriedCases>& carried) {
  const nlohmann::ordered_json model = nlohmann::ordered_json::parse(model_to_json(learned.model));
  nlohmann::ordered_json json{{"schema", "faultline/learning/1"}, {"name", learned.model.name}};
  if (learned.model.has_mechanics()) {
    json["identification"] = to_json(learned.identification);
    json["identification"].erase("state");
    json["mlp"] = {{"normalised_mse", learned.residual.normalised_mse},
                   {"persistence_mse", learned.residual.persistence_mse}};
  }
  for (const char* key : {"doubts", "sample_period_s", "sources", "validation", "evidence", "relations"})
    if (model.contains(key)) json[key] = model[key];
  json["cases"] = learned.cases.cases().size();
  if (carried) json["carried_over"] = carried_json(*carried);
  return json_text(json);
}

}  // namespace faultline
