// SPDX-License-Identifier: MIT
#include "lib/diagnose/stop/stop_reach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/number_text.hpp"
#include "lib/diagnose/stop/stop_signs.hpp"
#include "lib/explain/least_found.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {
namespace {

constexpr double kShortLog_s = 10.0;  // length of a log below which its report says what it can show

/// Returns the smallest torque of any cause on a joint that reaches the limit in the last moment.
SeenChange torque_seen(const StopRows& rows, const Model& model, int j) {
  const BalanceCourse& course = *rows.course;
  double information = 0.0;
  int values = 0;
  for (std::size_t k = 0; k < course.time_s.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    if (!(course.time_s[k] > rows.moment_start_s()) || !std::isfinite(course.square(row, j))) continue;
    information += course.unit_square(row, j);
    ++values;
  }
  SeenChange out{.label = {FaultKind::none, Joint::at(j)}, .by_this_log = true};
  out.unit = torque_unit(model.robot.chain.geometry[j].kind);
  out.could_be_found = information > 0.0;
  if (!out.could_be_found) {
    out.why_not = values == 0 ? "its torque balance was not judged" : "its rows have no weight";
    return out;
  }
  // Rows with a torque x give x^2 information / 2 + rows / 2 nats on average, less what healthy values
  // cost.
  const double nats = balance_limit(model.explain) + (kNatsOfHealthyRow - 0.5) * values;
  out.size = std::sqrt(2.0 * nats / information);
  return out;
}

bool needs_motion(FaultKind kind) {
  return kind == FaultKind::locked || kind == FaultKind::stuck_encoder ||
         kind == FaultKind::friction_increase;
}

SeenChange fault_seen(const FaultLabel& label, const std::vector<LeastFound>& sizes, const Model& model,
                      const Diagnosis& diagnosis) {
  SeenChange out{.label = label};
  const FaultDescription& fault = describe(label.kind);
  if (fault.size_count > 0) {
    const bool turns = model.robot.chain.geometry[label.joint.index()].kind == AxisKind::revolute;
    out.unit = unit_of(fault.sizes().back().feature, turns);
    for (const LeastFound& own : sizes)
      if (own.label == label) out.size = own.size;
    const bool is_share = fault.sizes().back().feature == SizeMeasure::torque_share;
    out.by_this_log = true;
    out.could_be_found = is_share ? out.size <= 1.0 : std::isfinite(out.size);
    if (!out.could_be_found) out.why_not = "the motion before the stop does not show it at any size";
  } else {
    const std::vector<Detectability>& reach = model.validation.reach;
    out.could_be_found = std::any_of(reach.begin(), reach.end(), [&](const Detectability& each) {
      return each.label == label && each.found > 0;
    });
    if (!out.could_be_found) out.why_not = "the model found it in no simulated log";
  }
  const std::vector<Joint>& resting = diagnosis.log.resting;
  if (needs_motion(label.kind) && std::find(resting.begin(), resting.end(), label.joint) != resting.end()) {
    out.could_be_found = false;
    out.why_not = "the joint hardly moved";
  }
  if (!out.could_be_found) out.size = std::numeric_limits<double>::quiet_NaN();
  return out;
}

/// States how weak the estimates of the effects of the day are.
std::string day_note(const std::vector<ConditionItem>& condition) {
  if (condition.empty())
    return "The effects of the day (friction, gain and offset of the torque) were not estimated from so short "
           "a log: those of the healthy logs are assumed.";
  const auto weak = std::count_if(condition.begin(), condition.end(),
                                  [](const ConditionItem& item) { return !item.is_determined(); });
  return fmt::format(
      "The effects of the day (friction, gain and offset of the torque) are estimated from these few seconds: "
      "for {} of {} the interval is no narrower than the range of healthy days.",
      weak, condition.size());
}

}  // namespace

std::vector<SeenChange> seen_changes(const StopRows& rows, const std::optional<UniformLog>& uniform,
                                     const Model& model, const Diagnosis& diagnosis) {
  std::vector<SeenChange> out;
  if (!uniform) return out;
  for (int j = 0; rows.course && j < rows.log.joints(); ++j) out.push_back(torque_seen(rows, model, j));
  const std::vector<LeastFound> sizes =
      least_found(*uniform, model.explain, model.labels, rows.moment_start_s());
  for (const FaultLabel& label : model.labels) out.push_back(fault_seen(label, sizes, model, diagnosis));
  return out;
}

std::optional<ShortLog> short_log(const Diagnosis& diagnosis, const StopRows& rows) {
  const LogFacts& log = diagnosis.log;
  if (!(log.end_s - log.start_s < kShortLog_s)) return std::nullopt;
  ShortLog out{rows.stop_s - log.start_s, log.end_s - rows.stop_s};
  out.notes.push_back(fmt::format(
      "The log has {} before the stop and {} after it. A fault that was there from the first row on looks like "
      "a healthy day unless it is larger than such days differ; what happened earlier is not in the log.",
      time_text(out.before_s, log.sample_period_s), time_text(out.after_s, log.sample_period_s)));
  out.notes.push_back(day_note(diagnosis.condition));
  for (const Joint joint : log.resting)
    out.notes.push_back(fmt::format(
        "Joint {} hardly moved: a lock, a stuck encoder or more friction of it could not be found.", joint));
  return out;
}

}  // namespace faultline
