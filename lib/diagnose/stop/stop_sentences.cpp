// SPDX-License-Identifier: MIT
#include "lib/diagnose/stop/stop_sentences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/blind_spots.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

std::string joined(const std::vector<std::string>& parts, const char* separator = ", ") {
  return fmt::format("{}", fmt::join(parts, separator));
}

std::string channel_value(double value, const std::string& unit) {
  if (unit == "healthy") return value_text(value) + " times its healthy spread";
  return value_text(value) + " " + unit;
}

std::string finding_sentence(const StopFinding& finding, double period_s) {
  const std::string name = finding.fault_id > 0 ? fmt::format("Fault {}", finding.fault_id)
                                                : std::string("A fault that the rows up to the stop show");
  std::string text = fmt::format("{} ({}, confidence {}) began at {}, {} before the stop", name,
                                 plain_words(finding.label), percent_text(finding.confidence),
                                 time_text(finding.onset_s, period_s), time_text(finding.before_s, period_s));
  text += finding.ended_before_s > 0.0
              ? fmt::format(", and ended {} before it", time_text(finding.ended_before_s, period_s))
              : ", and was present at it";
  if (!finding.by_rows_before)
    text += "; only rows after the stop raise its alarm, so that the stop itself may look like it";
  return text + ".";
}

std::vector<std::string> finding_sentences(const StopAnswer& stop, const Diagnosis& diagnosis) {
  std::vector<std::string> out;
  for (const StopFinding& finding : stop.findings)
    out.push_back(finding_sentence(finding, diagnosis.log.sample_period_s));
  if (stop.findings.empty()) out.push_back("No fault was found that began before the stop.");
  const auto after = std::count_if(diagnosis.faults.begin(), diagnosis.faults.end(),
                                   [&](const auto& fault) { return fault.onset_s > stop.question.time_s; });
  if (after > 0)
    out.push_back(
        fmt::format("{} of the log began after the stop: braking and what follows it may look like a "
                    "fault.",
                    counted(after, "fault")));
  return out;
}

std::string sign_sentence(const StopAnswer& stop, double period_s) {
  if (!stop.first_sign && std::all_of(stop.channels.begin(), stop.channels.end(), [](const auto& channel) {
        return channel.state == SignalState::not_looked;
      }))
    return "First sign: not known, since no signal was compared.";
  if (!stop.first_sign)
    return "No first sign: no torque and no motion left its healthy range and stayed outside, or returned to "
           "it, up to the stop.";
  const FirstSign& sign = *stop.first_sign;
  const std::string what =
      sign.kind == FaultKind::none
          ? fmt::format("{} of joint {}", words_of(sign.signal), sign.joint)
          : fmt::format("the onset of the fault, {}", plain_words({sign.kind, sign.joint}));
  return fmt::format("First sign: {}, {} before the stop: {}.", time_text(sign.time_s, period_s),
                     time_text(sign.before_s, period_s), what);
}

/// Whether the torque or the motion of a joint was outside of its healthy range.
bool deviates(const StopAnswer& stop, Joint joint) {
  return std::any_of(stop.channels.begin(), stop.channels.end(), [&](const StopChannel& channel) {
    return channel.joint == joint && channel.state == SignalState::changed &&
           channel.signal < StopSignal::torque;
  });
}

std::vector<std::string> leading_sentence(const StopAnswer& stop) {
  if (stop.leading.joint.is_none()) return {};
  std::string text =
      deviates(stop, stop.leading.joint)
          ? fmt::format("In the last {:.2g} s before the stop joint {} deviates most", stop.moment_s,
                        stop.leading.joint)
          : fmt::format(
                "No joint stands out in the last {:.2g} s before the stop; the largest deviation is "
                "that of joint {}",
                stop.moment_s, stop.leading.joint);
  text += fmt::format(": {} times its healthy spread", value_text(stop.leading.times_healthy));
  if (!stop.runner_up.joint.is_none())
    text += fmt::format("; next is joint {} with {}", stop.runner_up.joint,
                        value_text(stop.runner_up.times_healthy));
  return {text + "."};
}

std::string changed_words(const StopChannel& channel, double period_s) {
  std::string text = fmt::format("{} of joint {}: {}", words_of(channel.signal), channel.joint,
                                 channel_value(channel.value, channel.unit));
  if (channel.signal != StopSignal::range)
    text += fmt::format(", healthy up to {}", value_text(channel.limit));
  if (std::isfinite(channel.before)) text += fmt::format(", before at most {}", value_text(channel.before));
  return text + fmt::format(", from {} on", time_text(channel.since_s, period_s));
}

std::vector<std::string> changed_sentences(const StopAnswer& stop, double period_s) {
  std::vector<std::string> out;
  for (const StopChannel& channel : stop.channels) {
    if (channel.state == SignalState::changed)
      out.push_back("Changed: " + changed_words(channel, period_s) + ".");
    if (channel.state == SignalState::no_range && channel.value > channel.before)
      out.push_back(fmt::format(
          "Larger than before in this log, without a healthy range in the model: {} of joint {}: {}, before at "
          "most {}.",
          words_of(channel.signal), channel.joint, channel_value(channel.value, channel.unit),
          value_text(channel.before)));
  }
  return out;
}

/// The joints with a signal in a state, such as "joints 1, 3".
std::string joints_with(const StopAnswer& stop, StopSignal signal, SignalState state) {
  std::vector<std::string> joints;
  for (const StopChannel& channel : stop.channels)
    if (channel.signal == signal && channel.state == state)
      joints.push_back(fmt::format("{}", channel.joint));
  if (joints.empty()) return "";
  return (joints.size() == 1 ? "joint " : "joints ") + joined(joints);
}

std::vector<std::string> normal_sentence(const StopAnswer& stop) {
  std::vector<std::string> parts;
  for (const StopSignal signal : kStopSignals)
    if (const std::string joints = joints_with(stop, signal, SignalState::normal); !joints.empty())
      parts.push_back(fmt::format("{} ({})", words_of(signal), joints));
  if (parts.empty()) return {};
  std::vector<std::string> out = {
      fmt::format("Normal in the last {:.2g} s: {}.", stop.moment_s, joined(parts, "; "))};
  parts.clear();
  for (const StopSignal signal : kStopSignals)
    if (const std::string joints = joints_with(stop, signal, SignalState::as_before); !joints.empty())
      parts.push_back(fmt::format("{} ({})", words_of(signal), joints));
  if (!parts.empty())
    out.push_back(fmt::format("Outside of the healthy range, but no further than before in this log: {}.",
                              joined(parts, "; ")));
  return out;
}

std::vector<std::string> seen_sentence(const StopAnswer& stop) {
  std::vector<std::string> parts;
  const auto is_torque = [](const SeenChange& change) { return change.label.kind == FaultKind::none; };
  const bool by_balance = std::any_of(stop.seen.begin(), stop.seen.end(), is_torque);
  const FaultKind kind = by_balance ? FaultKind::none : FaultKind::torque_sensor_error;
  for (const SeenChange& change : stop.seen)
    if (change.label.kind == kind && change.could_be_found)
      parts.push_back(
          fmt::format("joint {} {} {}", change.label.joint, value_text(change.size), change.unit));
  if (parts.empty()) return {};
  return {fmt::format("{} that lasted for the last {:.2g} s would have been {} from these sizes on: {}.",
                      by_balance ? "A torque of any cause" : "An offset of the torque", stop.moment_s,
                      by_balance ? "a sign" : "found", joined(parts))};
}

void append(std::vector<std::string>& to, std::vector<std::string> more) {
  for (std::string& line : more) to.push_back(std::move(line));
}

}  // namespace

const char* to_string(StopSignal signal) {
  static constexpr std::array kNames{
      "torque_balance",    "motion_velocity",   "motion_position", "actuator", "control_law",
      "tracking_position", "tracking_velocity", "torque",          "speed",    "range"};
  return kNames[static_cast<std::size_t>(signal)];
}

const char* words_of(StopSignal signal) {
  static constexpr std::array kWords{"torque against what the healthy robot needs",
                                     "velocity against the regenerated motion",
                                     "position against the regenerated motion",
                                     "measured against commanded torque",
                                     "commanded torque against the control law",
                                     "position against its reference",
                                     "velocity against its reference",
                                     "largest torque",
                                     "largest speed",
                                     "distance outside of the healthy range of positions"};
  return kWords[static_cast<std::size_t>(signal)];
}

const char* to_string(SignalState state) {
  static constexpr std::array kNames{"normal", "changed", "as_before", "no_range", "not_looked_at"};
  return kNames[static_cast<std::size_t>(state)];
}

std::vector<std::string> stop_summary(const StopAnswer& stop, const Diagnosis& diagnosis) {
  const double period_s = diagnosis.log.sample_period_s;
  std::vector<std::string> out = finding_sentences(stop, diagnosis);
  out.push_back(sign_sentence(stop, period_s));
  append(out, leading_sentence(stop));
  append(out, changed_sentences(stop, period_s));
  append(out, normal_sentence(stop));
  append(out, seen_sentence(stop));
  return out;
}

std::vector<std::string> stop_not_looked(const StopAnswer& stop, const Diagnosis& diagnosis) {
  std::vector<std::string> out;
  for (const StopSignal signal : kStopSignals)
    if (const std::string joints = joints_with(stop, signal, SignalState::not_looked); !joints.empty())
      out.push_back(fmt::format("Not recorded, or not judged, in the last {:.2g} s: {} ({}).", stop.moment_s,
                                words_of(signal), joints));
  if (stop.seen.empty())
    out.push_back(
        "How small a change would have been seen is not known: the rows before the stop are too few.");
  const auto has = [&](StopSignal signal) {
    return std::any_of(stop.channels.begin(), stop.channels.end(),
                       [&](const StopChannel& channel) { return channel.signal == signal; });
  };
  if (!has(StopSignal::tracking_position) && !has(StopSignal::tracking_velocity))
    out.push_back("The log has no references of the motion: how the robot followed them was not looked at.");
  if (!has(StopSignal::actuator))
    out.push_back(
        "The model knows no relation of measured to commanded torque: the drives alone were not looked at.");
  for (const UnjudgedStretch& stretch : diagnosis.log.unjudged)
    if (stretch.start_s <= stop.question.time_s && stretch.end_s >= stop.question.time_s - stop.moment_s) {
      std::string words = unjudged_words(stretch, diagnosis.log);
      words[0] = words[0] == 'j' ? 'J' : 'N';
      out.push_back(words + ".");
    }
  out.push_back(
      "Safety circuits, the operator, other devices and the program of the controller are not in a joint log.");
  return out;
}

}  // namespace faultline
