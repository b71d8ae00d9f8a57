// SPDX-License-Identifier: MIT
#include "lib/golden/golden_set.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "lib/core/error.hpp"
#include "lib/core/files/inner_file.hpp"
#include "lib/robot/nearest_word.hpp"
#include "lib/robot/toml/toml_table.hpp"

namespace faultline {
namespace {

constexpr const char* kSchema = "faultline/golden/2";

/// A path below the folder, so that a golden file cannot name files elsewhere.
std::string inner_path(const TomlTable& table, const std::string& key) {
  const std::string path = table.text(key);
  if (!is_plain_path(path))
    table.fail(key, "expected the path of a file below the golden folder, such as logs/run.csv, found \"" +
                        path + "\"; write the path of the file in that folder");
  return path;
}

Tolerance tolerance(const TomlTable& table) {
  const Tolerance read{table.number("absolute", 0.0), table.number("relative", 0.0)};
  if (read.absolute < 0.0) table.fail("absolute", "must not be negative");
  if (read.relative < 0.0) table.fail("relative", "must not be negative");
  return read;
}

/// `more` are channels that this table may name besides those of the logs.
Tolerances tolerances(const TomlTable& table, const std::set<std::string>& more = {}) {
  Tolerances read;
  for (const std::string& name : table.keys()) {
    if (tolerance_family(name).empty() && !more.count(name)) {
      const std::string near = nearest_word(name, tolerance_families());
      table.fail(name, near.empty()
                           ? "is not among the compared channels (docs/golden.md lists them)"
                           : fmt::format("is not among the compared channels; did you mean \"{}\"?", near));
    }
    read.by_channel[name] = tolerance(table.table(name));
  }
  return read;
}

void read_length_rule(const TomlTable& table, Tolerances& into) {
  if (table.has("length_may_differ")) into.length_may_differ = table.flag("length_may_differ", false);
}

Joint joint(const TomlTable& table) { return Joint::numbered(static_cast<int>(table.integer("joint", 0))); }

FaultLabel label(const TomlTable& table) {
  std::vector<std::string> kinds;
  for (int i = 0; i < kFaultKinds; ++i) kinds.push_back(to_string(static_cast<FaultKind>(i)));
  return {fault_kind_from(table.choice("kind", kinds)), joint(table)};
}

Opinion opinion(const TomlTable& table) { return {label(table), table.any_number("confidence")}; }

ObservedEvent event(const TomlTable& table) {
  ObservedEvent e;
  e.label = label(table);
  e.onset_s = table.any_number("onset_s");
  e.alarm_s = table.any_number("alarm_s");
  e.end_s = table.any_number("end_s");
  e.confidence = table.any_number("confidence");
  e.evidence = table.any_number("evidence");
  e.decided_by = table.text("decided_by");
  e.opinions = {opinion(table.table("mlp")), opinion(table.table("rbfn"))};
  if (!table.is_array("could_also_be")) table.fail("could_also_be", "expected a list of faults, [] for none");
  for (const TomlTable& one : table.tables("could_also_be")) e.could_also_be.push_back(label(one));
  return e;
}

JointResidual residual(const TomlTable& table) {
  return {joint(table), table.any_number("velocity_rms"), table.any_number("velocity_peak"),
          table.any_number("peak_s"), table.any_number("position_rms")};
}

GoldenLog log(const TomlTable& table, int joints) {
  GoldenLog read;
  read.log = {inner_path(table, "file"), table.text("sha256")};
  read.trace = {inner_path(table, "trace"), table.text("trace_sha256")};
  read.expected.rows = table.integer("rows", -1);
  read.expected.verdict = table.choice("verdict", {"healthy", "faulty", "inconclusive"});
  if (read.expected.rows < 0) table.fail("rows", "expected the number of rows");
  if (!table.is_array("events")) table.fail("events", "expected a list of events, [] for none");
  for (const TomlTable& one : table.tables("events")) read.expected.events.push_back(event(one));
  for (const TomlTable& one : table.tables("residuals")) read.expected.residuals.push_back(residual(one));
  // A log that was only tracked has none.
  const int lines = static_cast<int>(read.expected.residuals.size());
  for (int j = 0; j < (lines == 0 ? 0 : std::max(joints, lines)); ++j)
    if (j >= joints || j >= std::ssize(read.expected.residuals) ||
        read.expected.residuals[j].joint != Joint::at(j))
      table.fail("residuals",
                 fmt::format("expected one line for each of the {} joints in their order", joints));
  read.tolerances = tolerances(table.table("tolerance"));
  read_length_rule(table, read.tolerances);
  return read;
}

std::vector<ParameterValue> values(const TomlTable& table, const std::string& key) {
  std::vector<ParameterValue> read;
  if (!table.is_array(key)) table.fail(key, "expected a list of values, [] for none");
  for (const TomlTable& one : table.tables(key))
    read.push_back({one.text("name"), one.any_number("value"), one.any_number("std"), one.text("unit")});
  return read;
}

GoldenIdentification identification(const TomlTable& table) {
  GoldenIdentification read;
  read.expected.status = table.text("status");
  read.expected.method = table.text("method");
  if (!table.is_array("logs")) table.fail("logs", "expected a list of log names");
  read.logs = table.texts("logs");
  std::set<std::string> names;
  read.expected.parameters = values(table, "parameters");
  for (const ParameterValue& value : read.expected.parameters)
    names.insert({value.name, value.name + "_std"});
  read.tolerances = tolerances(table.table("tolerance"), names);
  return read;
}

void check_names(const GoldenSet& set, const TomlTable& table) {
  std::set<std::string> names;
  for (const GoldenLog& log : set.logs)
    if (!names.insert(log.name()).second)
      table.fail("log", "two logs have the name \"" + log.name() + "\"; rename one");
  if (!set.identification) return;
  for (const std::string& name : set.identification->logs)
    if (!names.count(name)) table.fail("identification", "names a log that does not exist: \"" + name + "\"");
}

GoldenSet read(const TomlTable& table) {
  GoldenSet set;
  if (table.text("schema") != kSchema)
    table.fail("schema",
               fmt::format("expected \"{}\"; record the folder again with faultline golden record", kSchema));
  set.program_version = table.text("program");
  set.trace_points = static_cast<int>(table.integer("trace_points", 500));
  if (set.trace_points < 1) table.fail("trace_points", "must be positive");
  const TomlTable model = table.table("model");
  set.model_name = model.text("name");
  set.joints = static_cast<int>(model.integer("joints", 0));
  set.model = {inner_path(model, "file"), model.text("sha256")};
  set.cases = {inner_path(model, "cases"), model.text("cases_sha256")};
  std::set<std::string> names;
  set.model_values = values(model, "values");
  for (const ParameterValue& value : set.model_values) names.insert(value.name);
  set.tolerances = tolerances(table.table("tolerance"), names);
  read_length_rule(table, set.tolerances);
  if (table.has("identification")) set.identification = identification(table.table("identification"));
  for (const TomlTable& one : table.tables("log")) set.logs.push_back(log(one, set.joints));
  if (table.integer("log_count", -1) != std::ssize(set.logs))
    table.fail("log_count",
               fmt::format("does not match the {} logs in the file, which may be truncated: restore it",
                           set.logs.size()));
  check_names(set, table);
  table.finish();
  return set;
}

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

GoldenSet golden_from_text(const std::string& text, const std::string& where) {
  if (text.empty() || text.back() != '\n')
    throw Error(ErrorCode::input, where,
                "does not end with a complete line: the file is truncated, restore it");
  try {
    return read(TomlTable::parse(text, where));
  } catch (const Error& error) {
    throw Error(ErrorCode::input, error.where(), error.message());
  }
}

std::vector<std::string> GoldenSet::files() const {
  std::vector<std::string> paths = {model.path, cases.path};
  for (const GoldenLog& log : logs) paths.insert(paths.end(), {log.log.path, log.trace.path});
  return paths;
}

std::string golden_text(const GoldenSet& set) {
  std::string text = head(set);
  if (set.identification) text += identification_text(*set.identification);
  for (const GoldenLog& log : set.logs) text += log_text(log);
  return text;
}

}  // namespace faultline
