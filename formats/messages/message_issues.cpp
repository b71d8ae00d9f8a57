// SPDX-License-Identifier: MIT
#include "formats/messages/message_issues.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/text.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {
namespace {

constexpr std::size_t kNamedTopics = 20, kNamedJoints = 8;

std::string name_of(const Topic& topic) { return shortened(topic.name, kLongestName); }

/// Returns the issue of a row, with so many rows left out from it on.
Issue of_row(const char* code, Severity severity, std::int64_t row, std::string message, std::int64_t lost) {
  return {code, "", severity, std::move(message), row, kNan, lost, lost};
}

}  // namespace

std::string topics_sentence(const std::vector<Topic>& topics) {
  if (topics.empty()) return "it holds no topics";
  std::string text = "its topics are ";
  for (std::size_t i = 0; i < topics.size() && i < kNamedTopics; ++i)
    text += fmt::format("{}\"{}\" ({}, {})", i ? ", " : "", shortened(topics[i].name, kLongestName),
                        shortened(topics[i].type, kLongestName), shortened(topics[i].encoding, kLongestName));
  if (topics.size() > kNamedTopics) text += fmt::format(" and {} more", topics.size() - kNamedTopics);
  return text;
}

Issue lost_row(std::int64_t row, bool with_its_block) {
  if (with_its_block)
    return of_row("messages_lost", Severity::severe, row,
                  fmt::format("message {} of the joints was in a damaged part of the file and is lost", row),
                  1);
  return of_row("message_damaged", Severity::warning, row,
                fmt::format("message {} of the joints cannot be read: its lengths do not fit its size", row),
                1);
}

Issue late_row(std::int64_t row, const Topic& topic) {
  return of_row(
      "joints_appear_late", Severity::severe, row,
      fmt::format("message {} of \"{}\" names joints that no earlier message named, or joints in more "
                  "orders than a recording has; it was left out",
                  row, name_of(topic)),
      1);
}

Issue joints_changed(const JointStream& stream, const Topic& topic, std::int64_t first, std::int64_t rows) {
  std::string joints;
  for (std::size_t j = 0; j < std::min(kNamedJoints, stream.joints.size()); ++j)
    joints += (j > 0 ? ", " : "") + shortened(stream.joints[j], kLongestName);
  return of_row(
      "joints_changed", Severity::severe, first,
      fmt::format("from row {} on, all messages are of \"{}\" with the joints {}, which are not those "
                  "of the log: names or topic changed, or the recording continues with another robot. "
                  "These messages were left out; to read them instead, name their [log] topic and "
                  "joints in a robot file",
                  first, name_of(topic), joints),
      rows);
}

Issue damaged_message(const Topic& topic) {
  return {"message_damaged", "", Severity::warning, "a message of \"" + name_of(topic) + "\" cannot be read"};
}

Issue late_message(const Topic& topic) {
  return {
      "joints_appear_late", "", Severity::severe,
      "a message of \"" + name_of(topic) + "\" names joints that no earlier message named; it was left out"};
}

Issue late_joints(std::int64_t row) {
  return {
      "joints_appear_late", "", Severity::severe,
      fmt::format("message {} names joints that no earlier message named, or one joint twice; their values "
                  "were left out",
                  row),
      row};
}

Issue joint_missing(std::int64_t row, const std::string& joint) {
  return {"joint_missing", "", Severity::warning,
          fmt::format("message {} does not name joint \"{}\"; the values of this joint are missing", row,
                      shortened(joint, kLongestName)),
          row};
}

Issue array_length(std::int64_t row, std::size_t values, std::size_t joints) {
  return {
      "array_length", "", Severity::warning,
      fmt::format("message {} has {} values for {} joints; surplus values were left out, and lacking ones "
                  "count as missing",
                  row, values, joints),
      row};
}

Issue publishers_mixed(const Topic& topic) {
  return {
      "publishers_mixed", "", Severity::severe,
      "the positions alternate from row to row between two trajectories, as if two publishers send on \"" +
          name_of(topic) + "\"; record each publisher on its own topic"};
}

}  // namespace faultline
