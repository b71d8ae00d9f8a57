// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "formats/bytes/work_budget.hpp"
#include "formats/messages/expanded_messages.hpp"
#include "formats/messages/joint_layout.hpp"
#include "formats/messages/message_source.hpp"
#include "formats/messages/recording_checks.hpp"
#include "lib/core/error.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/text.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {
namespace {

/// Joint states that are read to find the joints, and bytes of messages of any kind.
constexpr std::int64_t kLearnedMessages = 4000;
constexpr std::uint64_t kLearnedBytes = 1 << 26;
/// Largest number of values of a block, for any number of columns: 8 MiB.
constexpr std::size_t kMostBlockValues = 1 << 20;
constexpr std::size_t kNamedJoints = 8;  ///< that a message lists
/// Converts to s: exactly for stamps that count from a start, to 2e-7 s for those since 1970.
double seconds_of(std::int64_t nanoseconds) {
  constexpr std::int64_t kExact = std::int64_t{1} << 53, kSecond = 1'000'000'000;
  if (nanoseconds < kExact) return static_cast<double>(nanoseconds) / 1e9;
  const std::int64_t seconds = nanoseconds / kSecond;
  return static_cast<double>(seconds) + static_cast<double>(nanoseconds % kSecond) / 1e9;
}

class JointStateReader : public RawReader {
 public:
  explicit JointStateReader(std::unique_ptr<MessageSource> source)
      : source_(std::make_unique<ExpandedMessages>(std::move(source))) {
    identity_.path = source_->path();
    identity_.format = source_->format();
  }

  const std::vector<RawColumn>& columns() const override { return layout_.columns; }
  double share_read() const override { return source_->share_read(); }

  void choose(const RecordingChoice& choice) override {
    source_->choose(choice.fields);
    source_->rewind();
    streams_ = {};
    learn_joints();
    source_->require_fields();
    layout_ = layout_joints(source_->topics(), streams_.streams(), choice, identity_.path);
    wanted_.assign(layout_.columns.size(), true);
    find_held_columns();
    rewind();
  }

  const Issues& issues() const override {
    all_issues_ = layout_.issues;
    all_issues_.merge(source_->issues());
    all_issues_.merge(issues_);
    if (at_end_) gap_.report(all_issues_);
    return all_issues_;
  }

  void rewind() override {
    source_->rewind();
    issues_ = {};
    gap_ = {};
    alternating_ = {};
    rivals_ = RivalStreams(streams_.streams(), layout_);
    at_end_ = false;
    identity_.rows_read = 0;
    held_.assign(layout_.columns.size(), kNan);
  }

  bool next(RawBlock& block, int max_rows) override {
    const std::size_t columns = std::max<std::size_t>(1, layout_.columns.size());
    max_rows = std::min(max_rows, static_cast<int>(std::max<std::size_t>(1, kMostBlockValues / columns)));
    begin_block(block, max_rows);
    block.first_row = identity_.rows_read;
    Message message;
    while (block.rows < max_rows) {
      if (!source_->next(message)) {
        end();
        break;
      }
      if (!take(message, block)) break;
    }
    for (std::size_t c = 0; c < block.columns.size(); ++c)
      if (wanted_[c]) block.columns[c].resize(block.rows);
    return block.rows > 0;
  }

 private:
  void learn_joints() {
    bool learned = learn_first_messages();
    if (!learned && source_->issues().find("channel_unknown")) {
      source_->rewind();  // the declarations of the messages came after them
      learned = learn_first_messages();
    }
    if (!learned)
      throw Error(ErrorCode::input, identity_.path,
                  "has no message with joint states that can be read; " + topics_sentence(source_->topics()) +
                      first_issue() +
                      ". Record the topic of the joint states, or name the fields of the messages in the "
                      "robot file: [log.columns] q = {topic = \"/arm/state\", field = \"q[#]\", first = 0}");
    streams_.settle();
  }

  /// Returns the first issue of the source, which may be the reason for missing joint states.
  std::string first_issue() const {
    const Issues& issues = source_->issues();
    return issues.empty() ? "" : " (" + issues.all().front().message + ")";
  }

  /// Learns the streams from the first messages; false without any joint state.
  bool learn_first_messages() {
    std::int64_t learned = 0;
    std::uint64_t bytes = 0;
    Message message;
    while (source_->next(message)) {
      learned += !message.lost && streams_.learn(source_->topics()[message.topic], message);
      bytes += message.bytes.size();
      if (learned > 0 && (learned >= kLearnedMessages || bytes >= kLearnedBytes)) break;
    }
    return learned > 0;
  }

  void begin_block(RawBlock& block, int max_rows) {
    block.rows = 0;
    block.columns.resize(layout_.columns.size());
    values_.assign(layout_.columns.size(), nullptr);
    for (std::size_t c = 0; c < layout_.columns.size(); ++c) {
      if (!wanted_[c]) continue;
      block.columns[c].resize(max_rows);
      values_[c] = block.columns[c].data();
    }
  }

  /// Takes a message; false when the block must end because a row was lost after its rows.
  bool take(const Message& message, RawBlock& block) {
    const Topic& topic = source_->topics()[message.topic];
    bool damaged = message.lost;
    const JointPlacing* placing = damaged ? nullptr : streams_.read(topic, message, state_, damaged);
    const bool is_late = placing && placing->stream < 0;
    if ((damaged || is_late) && message.topic == main_stream().topic) {
      lose_row(message, topic, is_late);
      return pass_lost_row(block);
    }
    if (damaged && !message.lost)
      issues_.add({"message_damaged", "", Severity::warning,
                   "a message of " + in_quotes(topic.name) + " cannot be read"});
    else if (is_late)
      issues_.add({"joints_appear_late", "", Severity::severe,
                   "a message of " + in_quotes(topic.name) +
                       " names joints that no earlier message named; it was left out"});
    else if (placing && placing->stream == layout_.main)
      put_row(message, *placing, block);
    else if (placing && lose_rival_rows(placing->stream))
      return pass_lost_row(block);
    else if (placing)
      hold(*placing);
    return true;
  }

  const JointStream& main_stream() const { return streams_.streams()[layout_.main]; }

  /// Reports a message that should be a row, but was lost with its part of the file, is damaged, or has
  /// joints that were not known when the columns were made.
  void lose_row(const Message& message, const Topic& topic, bool is_late) {
    const std::int64_t row = ++identity_.rows_read;
    if (message.lost)
      report_lost("messages_lost", Severity::severe, row, 1,
                  fmt::format("message {} of the joints was in a damaged part of the file and is lost", row));
    else if (is_late)
      report_lost("joints_appear_late", Severity::severe, row, 1,
                  fmt::format("message {} of {} names joints that no earlier message named, or joints in "
                              "more orders than a recording has; it was left out",
                              row, in_quotes(topic.name)));
    else
      report_lost(
          "message_damaged", Severity::warning, row, 1,
          fmt::format("message {} of the joints cannot be read: its lengths do not fit its size", row));
  }

  /// Adds the issue of rows that were left out, from row `first` on, which counts from 1.
  void report_lost(const char* code, Severity severity, std::int64_t first, std::int64_t rows,
                   const std::string& what) {
    issues_.add({code, "", severity, what, first, kNan, rows, rows});
  }

  /// Skips a lost row; false when the block must end, as its rows are consecutive.
  bool pass_lost_row(RawBlock& block) const {
    if (block.rows > 0) return false;
    block.first_row = identity_.rows_read;
    return true;
  }

  /// Handles a message of another stream; true when it is a row that the log lacks.
  bool lose_rival_rows(int s) {
    const std::int64_t rows = rivals_.rows_lost_by(s);
    if (rows == 0) return false;
    const JointStream& stream = streams_.streams()[s];
    std::string joints;
    for (std::size_t j = 0; j < std::min(kNamedJoints, stream.joints.size()); ++j)
      joints += (j > 0 ? ", " : "") + shortened(stream.joints[j], kLongestName);
    const std::int64_t first = identity_.rows_read + 1;
    report_lost("joints_changed", Severity::severe, first, rows,
                fmt::format("from row {} on, all messages are of {} with the joints {}, which are not those "
                            "of the log: names or topic changed, or the recording continues with another "
                            "robot. These messages were left out; to read them instead, name their [log] "
                            "topic and joints in a robot file",
                            first, in_quotes(source_->topics()[stream.topic].name), joints));
    identity_.rows_read += rows;
    return true;
  }

  void put_row(const Message& message, const JointPlacing& placing, RawBlock& block) {
    const int row = block.rows++;
    ++identity_.rows_read;
    source_->spend(kRowWork_ns + kValueWork_ns * std::ssize(layout_.columns));
    rivals_.at_row();
    if (placing.complete && state_.arrays[0].count == placing.joint_of.size()) watch_course(placing);
    gap_.add(state_.stamp_ns, message.receipt_ns);
    put(layout_.stamp_column, row, seconds_of(state_.stamp_ns));
    put(layout_.receipt_column, row, seconds_of(message.receipt_ns));
    const auto& columns = layout_.of_stream[layout_.main];
    for (std::size_t a = 0; a < columns.size(); ++a) put_array(columns[a], placing, state_.arrays[a], row);
    for (const int column : held_columns_) put(column, row, held_[column]);
    if (!placing.complete) note_partial(placing);
  }

  void watch_course(const JointPlacing& placing) {
    positions_.resize(placing.joint_of.size());
    for (std::size_t i = 0; i < placing.joint_of.size(); ++i)
      positions_[static_cast<std::size_t>(placing.joint_of[i])] = state_.arrays[0][i];
    alternating_.add(positions_);
  }

  void put(int column, int row, double value) {
    if (column < 0) return;
    if (double* values = values_[column]) values[row] = value;
  }

  void put_array(const JointColumns& columns, const JointPlacing& placing, const PackedNumbers& numbers,
                 int row) {
    if (!placing.complete || numbers.count < placing.joint_of.size())
      for (const int column : columns)
        if (column >= 0) put(column, row, kNan);
    const std::size_t count = std::min(numbers.count, placing.joint_of.size());
    for (std::size_t i = 0; i < count; ++i) {
      const int joint = placing.joint_of[i];
      if (joint >= 0 && columns[joint] >= 0) put(columns[joint], row, numbers[i]);
    }
    if (numbers.count > 0 && numbers.count != placing.joint_of.size())
      issues_.add({"array_length", "", Severity::warning,
                   fmt::format("message {} has {} values for {} joints; surplus values were left out, and "
                               "lacking ones count as missing",
                               identity_.rows_read, numbers.count, placing.joint_of.size()),
                   identity_.rows_read});
  }

  void note_partial(const JointPlacing& placing) {
    const std::int64_t row = identity_.rows_read;
    if (std::count(placing.joint_of.begin(), placing.joint_of.end(), -1) > 0)
      issues_.add({"joints_appear_late", "", Severity::severe,
                   fmt::format("message {} names joints that no earlier message named, or one joint twice; "
                               "their values were left out",
                               row),
                   row});
    const auto missing = std::find(placing.is_present.begin(), placing.is_present.end(), false);
    if (missing != placing.is_present.end())
      issues_.add({"joint_missing", "", Severity::warning,
                   fmt::format("message {} does not name joint {}; the values of this joint are missing", row,
                               in_quotes(main_stream().joints[missing - placing.is_present.begin()])),
                   row});
  }

  /// Keeps the values of another stream until its next message.
  void hold(const JointPlacing& placing) {
    for (std::size_t a = 0; a < state_.arrays.size(); ++a) {
      const JointColumns& columns = layout_.of_stream[placing.stream][a];
      const std::size_t count = std::min(state_.arrays[a].count, placing.joint_of.size());
      for (std::size_t i = 0; i < count; ++i)
        if (const int j = placing.joint_of[i]; j >= 0 && columns[j] >= 0)
          held_[columns[j]] = state_.arrays[a][i];
    }
  }

  /// Finds the columns of the streams other than the main one.
  void find_held_columns() {
    held_columns_.clear();
    for (int s = 0; s < std::ssize(layout_.of_stream); ++s)
      for (const JointColumns& array : layout_.of_stream[s])
        for (const int column : array)
          if (s != layout_.main && column >= 0) held_columns_.push_back(column);
  }

  void end() {
    if (at_end_) return;
    at_end_ = true;
    identity_.sha256 = source_->sha256();
    if (alternating_.alternate())
      issues_.add({"publishers_mixed", "", Severity::severe,
                   "the positions alternate from row to row between two trajectories, as if two publishers "
                   "send on " +
                       in_quotes(source_->topics()[main_stream().topic].name) +
                       "; record each publisher on its own topic"});
    rivals_.report_at_end(issues_);
  }

  std::unique_ptr<ExpandedMessages> source_;
  JointStreams streams_;
  JointLayout layout_;
  std::vector<double*> values_;  ///< of the block that is being filled; null for columns not wanted
  std::vector<int> held_columns_;
  std::vector<double> held_;  ///< by column: the latest value of the other streams
  JointMessage state_;
  ReceiptGap gap_;
  AlternatingRows alternating_;
  std::vector<double> positions_;  ///< of the present row, by joint
  RivalStreams rivals_;
  bool at_end_ = false;
  Issues issues_;
  mutable Issues all_issues_;
};

}  // namespace

std::unique_ptr<RawReader> read_joint_states(std::unique_ptr<MessageSource> source) {
  return std::make_unique<JointStateReader>(std::move(source));
}

}  // namespace faultline
