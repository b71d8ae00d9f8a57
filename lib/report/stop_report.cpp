// SPDX-License-Identifier: MIT
#include "lib/report/stop_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/core/json_values.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

using StopJson = nlohmann::ordered_json;

StopJson stop_finding_json(const StopFinding& finding) {
  return {{"fault", count_or_null(finding.fault_id)},
          {"kind", to_string(finding.label.kind)},
          {"joint", count_or_null(finding.label.joint.number())},
          {"onset_s", number_or_null(finding.onset_s)},
          {"confidence", number_or_null(finding.confidence)},
          {"began_before_s", number_or_null(finding.before_s)},
          {"ended_before_s", number_or_null(finding.ended_before_s)},
          {"by_rows_before", finding.by_rows_before}};
}

/// Null without a sign.
StopJson sign_json(const std::optional<FirstSign>& sign) {
  if (!sign) return nullptr;
  StopJson json = {{"time_s", number_or_null(sign->time_s)},
                   {"before_s", number_or_null(sign->before_s)},
                   {"joint", count_or_null(sign->joint.number())}};
  const bool is_signal = sign->kind == FaultKind::none;
  json["kind"] = is_signal ? StopJson(nullptr) : StopJson(to_string(sign->kind));
  json["signal"] = is_signal ? StopJson(to_string(sign->signal)) : StopJson(nullptr);
  return json;
}

/// Null without a joint.
StopJson leading_json(const LeadingJoint& leading) {
  if (leading.joint.is_none()) return nullptr;
  return {{"joint", leading.joint.number()}, {"times_healthy", number_or_null(leading.times_healthy)}};
}

StopJson channel_json(const StopChannel& channel) {
  return {{"joint", channel.joint.number()},
          {"signal", to_string(channel.signal)},
          {"state", to_string(channel.state)},
          {"value", number_or_null(channel.value)},
          {"before", number_or_null(channel.before)},
          {"limit", number_or_null(channel.limit)},
          {"unit", channel.unit},
          {"since_s", number_or_null(channel.since_s)}};
}

StopJson seen_json(const SeenChange& change) {
  const bool is_torque = change.label.kind == FaultKind::none;
  return {{"kind", is_torque ? "torque" : to_string(change.label.kind)},
          {"joint", count_or_null(change.label.joint.number())},
          {"could_be_found", change.could_be_found},
          {"size", number_or_null(change.size)},
          {"unit", text_or_null(change.unit)},
          {"by_this_log", change.by_this_log},
          {"why_not", text_or_null(change.why_not)}};
}

StopJson short_json(const std::optional<ShortLog>& log) {
  if (!log) return nullptr;
  return {{"before_s", number_or_null(log->before_s)},
          {"after_s", number_or_null(log->after_s)},
          {"notes", log->notes}};
}

/// Empty for a number that is not known.
std::string number_cell(double value) { return std::isfinite(value) ? value_text(value) : ""; }

const char* state_words(SignalState state) {
  switch (state) {
    case SignalState::normal:
      return "normal";
    case SignalState::changed:
      return "changed";
    case SignalState::as_before:
      return "as before";
    case SignalState::no_range:
      return "no healthy range";
    case SignalState::not_looked:
      return "not looked at";
  }
  return "";
}

std::string unit_words(const StopChannel& channel) {
  return channel.unit == "healthy" ? "times its healthy spread" : channel.unit;
}

std::string size_cell(const SeenChange& change) {
  if (!change.could_be_found) return "no: " + change.why_not;
  if (!std::isfinite(change.size)) return "yes";
  if (change.unit == "1") return "from " + percent_text(change.size);
  return fmt::format("from {} {}", value_text(change.size), change.unit);
}

}  // namespace

std::string stop_title(const StopAnswer& stop, double sample_period_s) {
  const std::string moment = time_text(stop.question.time_s, sample_period_s);
  if (stop.question.column.empty()) return "At the stop, " + moment;
  return fmt::format("At the stop, {} (first change of column \"{}\")", moment,
                     shortened(stop.question.column, kLongestName));
}

FactTable stop_signal_table(const StopAnswer& stop, double sample_period_s) {
  FactTable table{fmt::format("Signals in the last {:.2g} s before the stop", stop.moment_s),
                  {"signal", "joint", "state", "value", "before", "healthy up to", "unit", "since"},
                  {}};
  for (const StopChannel& channel : stop.channels)
    table.rows.push_back({words_of(channel.signal), fmt::format("{}", channel.joint),
                          state_words(channel.state), number_cell(channel.value), number_cell(channel.before),
                          number_cell(channel.limit), unit_words(channel),
                          std::isfinite(channel.since_s) ? time_text(channel.since_s, sample_period_s) : ""});
  return table;
}

FactTable stop_reach_table(const StopAnswer& stop) {
  FactTable table{"What so short a log could have shown", {"change", "could be found", "by"}, {}};
  if (!stop.short_log) return table;
  for (const SeenChange& change : stop.seen) {
    const bool is_torque = change.label.kind == FaultKind::none;
    table.rows.push_back(
        {is_torque ? fmt::format("joint {}: a torque of any cause", change.label.joint)
                   : plain_words(change.label),
         size_cell(change),
         change.by_this_log ? "motion and noise of this log" : "simulated logs of the model"});
  }
  return table;
}

StopJson stop_json(const StopAnswer& stop) {
  return {{"time_s", number_or_null(stop.question.time_s)},
          {"column", text_or_null(stop.question.column)},
          {"looked_from_s", number_or_null(stop.looked_from_s)},
          {"moment_s", number_or_null(stop.moment_s)},
          {"findings", list_of<StopJson>(stop.findings, stop_finding_json)},
          {"first_sign", sign_json(stop.first_sign)},
          {"leading", leading_json(stop.leading)},
          {"runner_up", leading_json(stop.runner_up)},
          {"signals", list_of<StopJson>(stop.channels, channel_json)},
          {"could_have_seen", list_of<StopJson>(stop.seen, seen_json)},
          {"short_log", short_json(stop.short_log)},
          {"summary", stop.summary},
          {"not_looked_at", stop.not_looked_at}};
}

}  // namespace faultline
