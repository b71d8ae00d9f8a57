// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "lib/golden/golden_set.hpp"

namespace faultline {
namespace {

std::string number(double value) { return std::isnan(value) ? "nan" : fmt::format("{:.9g}", value); }

/// Microseconds are kept, however large the clock is.
std::string time(double seconds) {
  return std::isfinite(seconds) ? fmt::format("{}", std::round(seconds * 1e6) / 1e6) : number(seconds);
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04X}", static_cast<int>(c));
    else
      out += c;
  }
  return out + "\"";
}

std::string key(const std::string& name) {
  for (const char c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-') return quoted(name);
  return name.empty() ? "\"\"" : name;
}

std::string tolerance_lines(const Tolerances& tolerances) {
  std::string text;
  for (const auto& [channel, t] : tolerances.by_channel)
    text += fmt::format("{} = {{absolute = {}, relative = {}}}\n", key(channel), number(t.absolute),
                        number(t.relative));
  return text;
}

std::string length_line(const Tolerances& tolerances) {
  return tolerances.length_may_differ ? fmt::format("length_may_differ = {}\n", *tolerances.length_may_differ)
                                      : "";
}

std::string value_lines(const std::vector<ParameterValue>& values) {
  std::string text;
  for (const ParameterValue& p : values)
    text += fmt::format("  {{name = {}, value = {}, std = {}, unit = {}}},\n", quoted(p.name),
                        number(p.value), number(p.std), quoted(p.unit));
  return text;
}

std::string head(const GoldenSet& set) {
  std::string text =
      "# Expected results of faultline for each log in this folder. Compare: faultline golden check;\n"
      "# accept changes: faultline golden accept. Tolerances may be edited: a number is as expected if\n"
      "# |actual - expected| <= absolute + relative * |expected|. Names: q, dq or dq2 the predicted motion,\n"
      "# velocity_rms or velocity_rms_2 a residual, parameter or m1 an identified one, model or model_a one\n"
      "# of the model's robot, trigger and threshold those of alarms.\n";
  text += fmt::format("schema = \"faultline/golden/2\"\nprogram = {}\nlog_count = {}\ntrace_points = {}\n",
                      quoted(set.program_version), set.logs.size(), set.trace_points);
  text += length_line(set.tolerances);
  text += fmt::format(
      "\n[model]\nname = {}\njoints = {}\nfile = {}\nsha256 = {}\ncases = {}\ncases_sha256 = {}\n",
      quoted(set.model_name), set.joints, quoted(set.model.path), quoted(set.model.sha256),
      quoted(set.cases.path), quoted(set.cases.sha256));
  text += "values = [\n" + value_lines(set.model_values) + "]\n";
  return text + "\n[tolerance]\n" + tolerance_lines(set.tolerances);
}

std::string identification_text(const GoldenIdentification& identified) {
  std::string text = "\n[identification]\nlogs = [";
  for (std::size_t i = 0; i < identified.logs.size(); ++i)
    text += (i ? ", " : "") + quoted(identified.logs[i]);
  text += fmt::format("]\nstatus = {}\nmethod = {}\nparameters = [\n", quoted(identified.expected.status),
                      quoted(identified.expected.method));
  text += value_lines(identified.expected.parameters) + "]\n";
  if (!identified.tolerances.by_channel.empty())
    text += "\n[identification.tolerance]\n" + tolerance_lines(identified.tolerances);
  return text;
}

std::string label_fields(const FaultLabel& label) {
  return fmt::format("kind = {}, joint = {}", quoted(to_string(label.kind)), label.joint);
}

std::string opinion_fields(const Opinion& opinion) {
  return fmt::format("{{{}, confidence = {}}}", label_fields(opinion.label), number(opinion.confidence));
}

std::string reason_fields(const ObservedEvent& e) {
  std::vector<std::string> others;
  for (const FaultLabel& label : e.could_also_be) others.push_back("{" + label_fields(label) + "}");
  return fmt::format(", evidence = {}, decided_by = {}, mlp = {}, rbfn = {}, could_also_be = [{}]",
                     number(e.evidence), quoted(e.decided_by), opinion_fields(e.opinions.mlp),
                     opinion_fields(e.opinions.rbfn), fmt::join(others, ", "));
}

std::string event_line(const ObservedEvent& e) {
  return fmt::format("  {{{}, onset_s = {}, alarm_s = {}, end_s = {}, confidence = {}{}}},\n",
                     label_fields(e.label), time(e.onset_s), time(e.alarm_s), time(e.end_s),
                     number(e.confidence), reason_fields(e));
}

std::string residual_line(const JointResidual& r) {
  return fmt::format(
      "  {{joint = {}, velocity_rms = {}, velocity_peak = {}, peak_s = {}, position_rms = {}}},\n", r.joint,
      number(r.velocity_rms), number(r.velocity_peak), time(r.velocity_peak_s), number(r.position_rms));
}

std::string log_text(const GoldenLog& log) {
  std::string text = fmt::format(
      "\n[[log]]\nfile = {}\nsha256 = {}\nrows = {}\ntrace = {}\ntrace_sha256 = {}\nverdict = {}\n",
      quoted(log.log.path), quoted(log.log.sha256), log.expected.rows, quoted(log.trace.path),
      quoted(log.trace.sha256), quoted(log.expected.verdict));
  text += length_line(log.tolerances) + (log.expected.events.empty() ? "events = [" : "events = [\n");
  for (const ObservedEvent& event : log.expected.events) text += event_line(event);
  text += "]\nresiduals = [\n";
  for (const JointResidual& r : log.expected.residuals) text += residual_line(r);
  text += "]\n";
  if (!log.tolerances.by_channel.empty()) text += "\n[log.tolerance]\n" + tolerance_lines(log.tolerances);
  return text;
}

}  // namespace

std::string golden_text(const GoldenSet& set) {
  std::string text = head(set);
  if (set.identification) text += identification_text(*set.identification);
  for (const GoldenLog& log : set.logs) text += log_text(log);
  return text;
}

}  // namespace faultline
