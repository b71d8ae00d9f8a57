// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/messages/joint_streams.hpp"
#include "formats/messages/message_source.hpp"
#include "lib/core/issue.hpp"

// Issues of the messages of a recording; rows count from 1.
namespace faultline {

/// Returns "its topics are ..".
std::string topics_sentence(const std::vector<Topic>& topics);

/// A message that should be a row and cannot be read, alone or `with_its_block`.
Issue lost_row(std::int64_t row, bool with_its_block);
/// A row that is lost because its joints were not known when the columns were made.
Issue late_row(std::int64_t row, const Topic& topic);
/// `rows` from `first` on, lost because they belong to another stream while the main one sends nothing.
Issue joints_changed(const JointStream& stream, const Topic& topic, std::int64_t first, std::int64_t rows);
/// A message of another topic that cannot be read, or that has unknown joints.
Issue damaged_message(const Topic& topic);
Issue late_message(const Topic& topic);

/// Rows that were read in part.
Issue late_joints(std::int64_t row);
Issue joint_missing(std::int64_t row, const std::string& joint);
Issue array_length(std::int64_t row, std::size_t values, std::size_t joints);

Issue publishers_mixed(const Topic& topic);

}  // namespace faultline
