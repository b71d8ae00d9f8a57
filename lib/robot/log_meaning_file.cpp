// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "lib/core/atomic_file.hpp"
#include "lib/core/matrix/decompositions.hpp"
#include "lib/core/text.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/column_matching.hpp"
#include "lib/robot/log_preset.hpp"
#include "lib/robot/robot.hpp"
#include "lib/robot/robot_file_parts.hpp"

namespace faultline {
namespace {

constexpr double kSingular = 1e-9;  ///< ratio of smallest to largest singular value of a singular coupling

namespace fs = std::filesystem;

constexpr const char* kExtension = ".toml";

/// The folder of the user's own presets; empty if there is none.
fs::path own_folder() {
  const char* own = std::getenv("FAULTLINE_PRESETS");
  return own ? own : "";
}

/// Returns the names of all presets, sorted and joined by commas.
std::string presets_there_are() {
  std::vector<std::string> names;
  for (const KnownPreset& preset : known_presets()) names.push_back(preset.name);
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(own_folder(), none))
    if (entry.path().extension() == kExtension) names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Returns the preset that `table` names under `key`: the meaning of the columns of a common recorder. Looks
/// for a name such as "ur-rtde" in the folder that the environment variable FAULTLINE_PRESETS names, then
/// among the built-in presets; takes a text that ends in .toml as a path. Throws Error(usage) that lists the
/// available presets.
TomlTable load_log_preset(const TomlTable& table, const std::string& key) {
  const std::string name = table.text(key);
  if (name.ends_with(kExtension)) return TomlTable::parse(read_file(name), name);
  const fs::path own = own_folder() / (name + kExtension);
  std::error_code none;
  if (!own_folder().empty() && name.find('/') == std::string::npos && fs::exists(own, none))
    return TomlTable::parse(read_file(own.string()), own.string());
  for (const KnownPreset& preset : known_presets())
    if (preset.name == name) return TomlTable::parse(preset.text, "preset " + name);
  table.fail(key, "there is no preset \"" + name + "\"; there are " + presets_there_are() +
                      ", and a path that ends in .toml is a file of your own");
}

ColumnSpec column_spec(const TomlTable& table) {
  ColumnSpec spec;
  spec.name = table.text("name", "");
  spec.topic = table.text("topic", "");
  if (spec.topic.empty() == table.has("field"))
    table.fail("field", "a value of a message needs both its topic and its field");
  if (table.has("field") && table.has("name"))
    table.fail("name", "expected either the name of a column, or the topic and the field of a message");
  if (table.has("field")) spec.name = spec.topic + "/" + table.text("field");
  spec.unit = table.text("unit", "");
  spec.sign = table.number("sign", 1.0);
  if (std::abs(spec.sign) != 1.0) table.fail("sign", fmt::format("expected 1 or -1, found {}", spec.sign));
  spec.scale = table.number("scale", 1.0);
  if (spec.scale == 0.0) table.fail("scale", "expected a number other than 0");
  spec.offset = table.number("offset", 0.0);
  return spec;
}

ColumnSpec column_spec(const TomlTable& columns, const std::string& channel) {
  if (columns.is_table(channel)) return column_spec(columns.table(channel));
  ColumnSpec spec;
  spec.name = columns.text(channel);
  return spec;
}

std::vector<std::string> channel_names(int joints) {
  std::vector<std::string> names{"t"};
  for (const Quantity quantity : kJointQuantities)
    for (int j = 0; j < joints; ++j) names.push_back(to_string(Channel{quantity, Joint::at(j)}));
  return names;
}

Eigen::MatrixXd read_coupling(const TomlTable& log, int joints) {
  const auto rows = log.number_rows("coupling", joints);
  if (static_cast<int>(rows.size()) != joints)
    log.fail("coupling", fmt::format("expected {0} rows of {0} numbers, one per joint, found {1}", joints,
                                     counted(static_cast<long long>(rows.size()), "row")));
  Eigen::MatrixXd matrix(joints, joints);
  for (int i = 0; i < joints; ++i)
    for (int k = 0; k < joints; ++k) matrix(i, k) = rows[i][k];
  const Eigen::VectorXd stretches = singular_values(matrix);
  if (stretches[joints - 1] <= kSingular * stretches[0])
    log.fail(
        "coupling",
        "is singular: some motion of the drives moves no joint; expected the matrix C of q = C q_logged");
  return matrix;
}

/// Returns `choice` with the values that [log] sets for the messages of a recording.
RecordingChoice read_recording(const TomlTable& log, int joints, RecordingChoice choice) {
  choice.topic = log.text("topic", choice.topic);
  if (log.has("time")) choice.time = log.choice_of("time", {MessageTime::header, MessageTime::receipt});
  if (!log.has("joints")) return choice;
  choice.joints = log.texts("joints");
  if (static_cast<int>(choice.joints.size()) != joints)
    log.fail("joints", fmt::format("expected {} names, base to tip, found {}", joints, choice.joints.size()));
  const std::set<std::string> different(choice.joints.begin(), choice.joints.end());
  if (different.size() != choice.joints.size()) log.fail("joints", "names a joint twice");
  return choice;
}

/// Reads the columns of all joints from one key: "#" in the name stands for the joint's number, which starts
/// at `first`.
void read_family(const TomlTable& columns, const std::string& family, int joints, ColumnMap& map) {
  ColumnSpec pattern;
  std::int64_t first = 1;
  if (columns.is_table(family)) {
    const TomlTable table = columns.table(family);
    pattern = column_spec(table);
    first = table.integer("first", first);
  } else {
    pattern.name = columns.text(family);
  }
  const auto sign = pattern.name.find('#');
  if (sign == std::string::npos)
    columns.fail(family, "stands for all joints, so its name needs a # in place of the joint number");
  for (int j = 0; j < joints; ++j) {
    ColumnSpec spec = pattern;
    spec.name.replace(sign, 1, std::to_string(first + j));
    if (sign < spec.topic.size()) spec.topic.replace(sign, 1, std::to_string(first + j));
    map[fmt::format("{}{}", family, Joint::at(j))] = spec;
  }
}

bool is_family(const std::string& key) { return !canonical_channel(key) && canonical_channel(key + "1"); }

void read_columns(const TomlTable& columns, int joints, ColumnMap& map) {
  const auto names = channel_names(joints);
  for (const std::string& key : columns.keys())
    if (is_family(key)) read_family(columns, key, joints, map);
  for (const std::string& channel : columns.keys()) {
    if (is_family(channel)) continue;
    if (channel != kStopChannel && std::find(names.begin(), names.end(), channel) == names.end())
      columns.fail(
          channel,
          fmt::format("is not a channel of a robot with {0} joints; expected t, q1..q{0}, "
                      "dq1..dq{0}, tau1..tau{0}, q_ref1..q_ref{0}, dq_ref1..dq_ref{0}, "
                      "tau_ref1..tau_ref{0} or tau_meas1..tau_meas{0}, q, dq, .. for all joints, or stop",
                      joints));
    map[channel] = column_spec(columns, channel);
  }
}

/// Overwrites in `meaning` the values that the table sets.
void read_meaning(const TomlTable& log, int joints, LogMeaning& meaning) {
  if (log.has("torque"))
    meaning.torque =
        log.choice_of("torque", {TorqueMeaning::commanded, TorqueMeaning::measured, TorqueMeaning::current});
  if (log.has("torque_between_samples"))
    meaning.torque_between_samples = log.choice_of(
        "torque_between_samples", {TorqueTiming::held, TorqueTiming::linear, TorqueTiming::unknown});
  if (log.has("coupling")) meaning.coupling = read_coupling(log, joints);
  meaning.recording = read_recording(log, joints, meaning.recording);
  read_columns(log.table("columns"), joints, meaning.columns);
  meaning.recording.fields.clear();
  for (const auto& [channel, spec] : meaning.columns)
    if (!spec.topic.empty())
      meaning.recording.fields.push_back({spec.topic, spec.name.substr(spec.topic.size() + 1)});
}

}  // namespace

LogMeaning log_meaning_from_table(const TomlTable& log, int joints) {
  LogMeaning meaning;
  if (log.has("preset")) {
    const TomlTable preset = load_log_preset(log, "preset");
    read_meaning(preset.table("log"), joints, meaning);
    preset.finish();
  }
  read_meaning(log, joints, meaning);
  return meaning;
}

}  // namespace faultline
