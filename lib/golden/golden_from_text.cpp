// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "lib/core/error.hpp"
#include "lib/core/files/plain_name.hpp"
#include "lib/golden/golden_set.hpp"
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

FaultLabel label(const TomlTable& table) {
  std::vector<std::string> kinds;
  for (int i = 0; i < kFaultKinds; ++i) kinds.push_back(to_string(static_cast<FaultKind>(i)));
  return {fault_kind_from(table.choice("kind", kinds)), static_cast<int>(table.integer("joint", 0))};
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
  return {static_cast<int>(table.integer("joint", 0)), table.any_number("velocity_rms"),
          table.any_number("velocity_peak"), table.any_number("peak_s"), table.any_number("position_rms")};
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
    if (j >= joints || j >= std::ssize(read.expected.residuals) || read.expected.residuals[j].joint != j + 1)
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

}  // namespace faultline
