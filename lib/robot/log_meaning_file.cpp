// SPDX-License-Identifier: MIT
#include "lib/robot/log_meaning_file.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <set>

#include "lib/core/text.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/robot/robot_words.hpp"

namespace faultline {
namespace {

constexpr double kSingular = 1e-9;  ///< smallest to largest singular value

ColumnSpec column_spec(const TomlTable& columns, const std::string& channel) {
  ColumnSpec spec;
  if (!columns.is_table(channel)) {
    spec.name = columns.text(channel);
    return spec;
  }
  const TomlTable table = columns.table(channel);
  spec.name = table.text("name", "");
  spec.unit = table.text("unit", "");
  spec.sign = table.number("sign", 1.0);
  if (std::abs(spec.sign) != 1.0) table.fail("sign", fmt::format("expected 1 or -1, found {}", spec.sign));
  spec.scale = table.number("scale", 1.0);
  if (spec.scale == 0.0) table.fail("scale", "expected a number other than 0");
  spec.offset = table.number("offset", 0.0);
  return spec;
}

std::vector<std::string> channel_names(int joints) {
  std::vector<std::string> names{"t"};
  for (const Quantity quantity : kJointQuantities)
    for (int j = 1; j <= joints; ++j) names.push_back(to_string(Channel{quantity, j}));
  return names;
}

Eigen::MatrixXd read_coupling(const TomlTable& log, int joints) {
  const auto rows = log.number_rows("coupling", joints);
  if (static_cast<int>(rows.size()) != joints)
    log.fail("coupling", fmt::format("expected {0} rows of {0} numbers, one each a joint, found {1}", joints,
                                     counted(static_cast<long long>(rows.size()), "row")));
  Eigen::MatrixXd matrix(joints, joints);
  for (int i = 0; i < joints; ++i)
    for (int k = 0; k < joints; ++k) matrix(i, k) = rows[i][k];
  const Eigen::VectorXd stretches = Eigen::JacobiSVD<Eigen::MatrixXd>(matrix).singularValues();
  if (stretches[joints - 1] <= kSingular * stretches[0])
    log.fail(
        "coupling",
        "is singular: some motion of the drives moves no joint; expected the matrix C of q = C q_logged");
  return matrix;
}

/// Which messages of a recording are the log.
RecordingChoice read_recording(const TomlTable& log, int joints) {
  RecordingChoice choice;
  choice.topic = log.text("topic", "");
  if (log.has("time")) choice.time = log.choice_of("time", {MessageTime::header, MessageTime::receipt});
  if (!log.has("joints")) return choice;
  choice.joints = log.texts("joints");
  if (static_cast<int>(choice.joints.size()) != joints)
    log.fail("joints", fmt::format("expected {} names, base to tip, found {}", joints, choice.joints.size()));
  const std::set<std::string> different(choice.joints.begin(), choice.joints.end());
  if (different.size() != choice.joints.size()) log.fail("joints", "names a joint twice");
  return choice;
}

}  // namespace

LogMeaning log_meaning_from_table(const TomlTable& log, int joints) {
  LogMeaning result;
  if (log.has("torque"))
    result.torque =
        log.choice_of("torque", {TorqueMeaning::commanded, TorqueMeaning::measured, TorqueMeaning::current});
  if (log.has("torque_between_samples"))
    result.torque_between_samples = log.choice_of(
        "torque_between_samples", {TorqueTiming::held, TorqueTiming::linear, TorqueTiming::unknown});
  if (log.has("coupling")) result.coupling = read_coupling(log, joints);
  result.recording = read_recording(log, joints);
  const TomlTable columns = log.table("columns");
  const auto names = channel_names(joints);
  for (const std::string& channel : columns.keys()) {
    if (std::find(names.begin(), names.end(), channel) == names.end())
      columns.fail(channel,
                   fmt::format("is no channel of a robot with {0} joints; expected t, q1..q{0}, dq1..dq{0}, "
                               "tau1..tau{0}, q_ref1..q_ref{0}, dq_ref1..dq_ref{0}, tau_ref1..tau_ref{0} or "
                               "tau_meas1..tau_meas{0}",
                               joints));
    result.columns[channel] = column_spec(columns, channel);
  }
  return result;
}

}  // namespace faultline
