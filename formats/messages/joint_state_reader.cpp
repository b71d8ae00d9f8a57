// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "formats/bytes/work_budget.hpp"
#include "formats/messages/joint_layout.hpp"
#include "formats/messages/message_issues.hpp"
#include "formats/messages/message_source.hpp"
#include "lib/core/error.hpp"
#include "lib/core/issue.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {
namespace {

/// Joint states that are read to find the joints, and bytes of messages of any kind.
constexpr std::int64_t kLearnedMessages = 4000;
constexpr std::uint64_t kLearnedBytes = 1 << 26;
/// Largest number of values of a block, for any number of columns: 8 MiB.
constexpr std::size_t kMostBlockValues = 1 << 20;
/// rad or m. Closer positions of two publishers count as one; the codes of an encoder at rest may alternate
/// by less.
constexpr double kApart = 1e-2;
constexpr double kNear = 0.25;                 ///< share of the distance to the last row
constexpr double kMostShare = 0.5;             ///< share of rows that may look like two publishers
constexpr std::int64_t kFewestJointRows = 20;  ///< rows that the check for two publishers needs

double distance(const std::vector<double>& position, const std::vector<double>& other) {
  double largest = 0.0;
  for (std::size_t j = 0; j < std::min(position.size(), other.size()); ++j)
    largest = std::fmax(largest, std::abs(position[j] - other[j]));
  return largest;
}

/// Tests if the positions of the rows are those of two publishers in turn: each row is near the one before
/// the last, not near the last one.
class AlternatingRows {
 public:
  /// Adds the positions of all joints, always in the same order.
  void add(const std::vector<double>& position) {
    if (!one_before_.empty()) {
      const double to_last = distance(position, last_);
      alternating_ += to_last > kApart && distance(position, one_before_) < kNear * to_last;
      ++rows_;
    }
    one_before_.swap(last_);
    last_ = position;
  }

  /// True when most of the rows so far alternate.
  bool alternate() const {
    return rows_ >= kFewestJointRows &&
           static_cast<double>(alternating_) > kMostShare * static_cast<double>(rows_);
  }

 private:
  std::vector<double> last_, one_before_;
  std::int64_t rows_ = 0, alternating_ = 0;
};

/// Delay from the stamps in the headers to the receipt of the messages.
class ReceiptGap {
 public:
  void add(std::int64_t stamp_ns, std::int64_t receipt_ns) {
    if (stamp_ns == 0) return;
    const double gap_s = static_cast<double>(receipt_ns - stamp_ns) / 1e9;
    least_s_ = std::min(least_s_, gap_s);
    most_s_ = std::max(most_s_, gap_s);
    sum_s_ += gap_s;
    ++messages_;
  }

  /// Adds a note when some delay is not 0.
  void report(Issues& issues) const {
    if (messages_ == 0 || (least_s_ == 0.0 && most_s_ == 0.0)) return;
    issues.add({"receipt_gap", "t", Severity::note,
                fmt::format("the messages were received {:.4g} s after the stamps in their headers on "
                            "average, between {:.4g} and {:.4g} s. To choose the time, name it in the robot "
                            "file: [log] time = \"header\" or \"receipt\"",
                            sum_s_ / static_cast<double>(messages_), least_s_, most_s_)});
  }

 private:
  double least_s_ = std::numeric_limits<double>::infinity();
  double most_s_ = -std::numeric_limits<double>::infinity();
  double sum_s_ = 0.0;
  std::int64_t messages_ = 0;
};

/// Converts to s: exactly for stamps that count from a start, to 2e-7 s for those since 1970.
double seconds_of(std::int64_t nanoseconds) {
  constexpr std::int64_t kExact = std::int64_t{1} << 53, kSecond = 1'000'000'000;
  if (nanoseconds < kExact) return static_cast<double>(nanoseconds) / 1e9;
  const std::int64_t seconds = nanoseconds / kSecond;
  return static_cast<double>(seconds) + static_cast<double>(nanoseconds % kSecond) / 1e9;
}

class JointStateReader : public RawReader {
 public:
  explicit JointStateReader(std::unique_ptr<MessageSource> source) : source_(std::move(source)) {
    identity_.path = source_->path();
    identity_.format = source_->format();
    learn_joints();
    choose({});
  }

  const std::vector<RawColumn>& columns() const override { return layout_.columns; }
  double share_read() const override { return source_->share_read(); }

  void choose(const RecordingChoice& choice) override {
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
                  "has no sensor_msgs/JointState message that can be read; " +
                      topics_sentence(source_->topics()) + first_issue() +
                      ". Record the topic of the joint states, or export the signals as CSV");
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
    const bool of_main_topic = message.topic == main_stream().topic;
    if (damaged && of_main_topic) {
      issues_.add(lost_row(++identity_.rows_read, message.lost));
      return pass_lost_row(block);
    }
    if (placing && placing->stream < 0 && of_main_topic) {
      issues_.add(late_row(++identity_.rows_read, topic));
      return pass_lost_row(block);
    }
    if (damaged && !message.lost)
      issues_.add(damaged_message(topic));
    else if (placing && placing->stream < 0)
      issues_.add(late_message(topic));
    else if (placing && placing->stream == layout_.main)
      put_row(message, *placing, block);
    else if (placing && lose_rival_rows(placing->stream))
      return pass_lost_row(block);
    else if (placing)
      hold(*placing);
    return true;
  }

  const JointStream& main_stream() const { return streams_.streams()[layout_.main]; }

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
    issues_.add(joints_changed(stream, source_->topics()[stream.topic], identity_.rows_read + 1, rows));
    identity_.rows_read += rows;
    return true;
  }

  void put_row(const Message& message, const JointPlacing& placing, RawBlock& block) {
    const int row = block.rows++;
    ++identity_.rows_read;
    source_->spend(kRowWork_ns + kValueWork_ns * std::ssize(layout_.columns));
    rivals_.at_row();
    if (placing.complete && state_.position.count == placing.joint_of.size()) watch_course(placing);
    gap_.add(state_.stamp_ns, message.receipt_ns);
    put(layout_.stamp_column, row, seconds_of(state_.stamp_ns));
    put(layout_.receipt_column, row, seconds_of(message.receipt_ns));
    const auto& columns = layout_.of_stream[layout_.main];
    put_array(columns[0], placing, state_.position, row);
    put_array(columns[1], placing, state_.velocity, row);
    put_array(columns[2], placing, state_.effort, row);
    for (const int column : held_columns_) put(column, row, held_[column]);
    if (!placing.complete) note_partial(placing);
  }

  void watch_course(const JointPlacing& placing) {
    positions_.resize(placing.joint_of.size());
    for (std::size_t i = 0; i < placing.joint_of.size(); ++i)
      positions_[static_cast<std::size_t>(placing.joint_of[i])] = state_.position[i];
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
      issues_.add(array_length(identity_.rows_read, numbers.count, placing.joint_of.size()));
  }

  void note_partial(const JointPlacing& placing) {
    const auto& joints = streams_.streams()[layout_.main].joints;
    if (std::count(placing.joint_of.begin(), placing.joint_of.end(), -1) > 0)
      issues_.add(late_joints(identity_.rows_read));
    const auto missing = std::find(placing.is_present.begin(), placing.is_present.end(), false);
    if (missing != placing.is_present.end())
      issues_.add(joint_missing(identity_.rows_read, joints[missing - placing.is_present.begin()]));
  }

  /// Keeps the values of another stream until its next message.
  void hold(const JointPlacing& placing) {
    const std::array arrays{&state_.position, &state_.velocity, &state_.effort};
    for (std::size_t a = 0; a < arrays.size(); ++a) {
      const JointColumns& columns = layout_.of_stream[placing.stream][a];
      const std::size_t count = std::min(arrays[a]->count, placing.joint_of.size());
      for (std::size_t i = 0; i < count; ++i)
        if (const int joint = placing.joint_of[i]; joint >= 0 && columns[joint] >= 0)
          held_[columns[joint]] = (*arrays[a])[i];
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
    if (alternating_.alternate()) issues_.add(publishers_mixed(source_->topics()[main_stream().topic]));
    rivals_.report_at_end(issues_);
  }

  std::unique_ptr<MessageSource> source_;
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
