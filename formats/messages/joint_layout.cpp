// SPDX-License-Identifier: MIT
#include "formats/messages/joint_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "formats/messages/message_source.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/log/raw_reader.hpp"
#include "lib/log/units.hpp"

namespace faultline {
namespace {

constexpr std::array kMeasured{Quantity::q, Quantity::dq, Quantity::tau};
constexpr std::array kCommanded{Quantity::q_ref, Quantity::dq_ref, Quantity::tau_ref};
/// Quantities of a stream with torques only.
constexpr std::array kMeasuredBeside{Quantity::q, Quantity::dq, Quantity::tau_meas};
/// Upper limit of the columns; each column beyond those of the main stream has a value in each row.
constexpr std::size_t kMostLogColumns = 1024;
constexpr std::array kArrays{"position", "velocity", "effort"};  ///< in the order of JointMessage

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + in_quotes(name);
  return text;
}

/// True for a topic of commands to the robot.
bool is_command(const Topic& topic) {
  if (topic.role != TopicRole::unknown) return topic.role == TopicRole::reference;
  return parse_name("position/" + topic.name).quantity == Quantity::q_ref;
}

/// True for the topic that the robot file names, and for those of joint states made of its messages.
bool is_chosen(const std::string& topic, const std::string& chosen) {
  return chosen.empty() || topic == chosen || topic.starts_with(chosen + "/");
}

int choose_main(const std::vector<Topic>& topics, const std::vector<JointStream>& streams,
                const RecordingChoice& choice, const std::string& path) {
  const auto name_of = [&](const JointStream& stream) { return topics[stream.topic].name; };
  const auto rank = [&](const JointStream& stream) {
    const Topic& topic = topics[stream.topic];
    return std::tuple(stream.has[0], topic.name != kExtraTopic, topic.role != TopicRole::fields,
                      !is_command(topic), topic.name.find("joint_states") != std::string::npos, stream.has[2],
                      stream.messages);
  };
  int best = -1;
  for (int s = 0; s < std::ssize(streams); ++s) {
    if (!is_chosen(name_of(streams[s]), choice.topic)) continue;
    if (best < 0 || rank(streams[s]) > rank(streams[best])) best = s;
  }
  if (best >= 0) return best;
  std::set<std::string> names;
  for (const JointStream& stream : streams) names.insert(name_of(stream));
  throw Error(ErrorCode::input, path,
              "has no topic " + in_quotes(choice.topic) +
                  " with joint states, although the robot file names it as [log] topic; the topics with "
                  "joint states are " +
                  listed({names.begin(), names.end()}));
}

/// Returns the order by number of joints whose names differ by a number only; empty for other names.
std::vector<int> numbered_order(const std::vector<std::string>& joints) {
  std::vector<std::pair<int, int>> numbered;
  std::set<std::string> stems;
  std::set<int> numbers;
  for (int j = 0; j < std::ssize(joints); ++j) {
    const ParsedName reading = parse_name(joints[j]);
    if (!reading.number) return {};
    stems.insert(reading.stem);
    numbers.insert(*reading.number);
    numbered.emplace_back(*reading.number, j);
  }
  if (stems.size() != 1 || numbers.size() != joints.size()) return {};
  std::sort(numbered.begin(), numbered.end());
  std::vector<int> order;
  for (const auto& [number, joint] : numbered) order.push_back(joint);
  return order;
}

/// Returns the joints of the log, base to tip, as indices into those of the main stream.
std::vector<int> order_joints(const JointStream& stream, const RecordingChoice& choice,
                              const std::string& path, Issues& issues) {
  std::vector<int> order;
  if (choice.joints.empty()) {
    order = numbered_order(stream.joints);
    if (!order.empty()) return order;
    for (int j = 0; j < std::ssize(stream.joints); ++j) order.push_back(j);
    if (stream.joints.size() > 1)
      issues.add(
          {"joint_order", "", Severity::note,
           "the joints keep the order of the messages: " + listed(stream.joints) +
               ". If this order is not from base to tip, list the joints in the robot file: [log] joints = "
               "[...]"});
    return order;
  }
  for (const std::string& joint : choice.joints) {
    order.push_back(index_of(stream.joints, joint));
    if (order.back() < 0)
      throw Error(ErrorCode::input, path,
                  "has no joint " + in_quotes(joint) +
                      ", although the robot file names it in [log] joints; the messages have " +
                      listed(stream.joints));
  }
  return order;
}

class Layouter {
 public:
  Layouter(const std::vector<Topic>& topics, const std::vector<JointStream>& streams)
      : topics_(topics), streams_(streams) {}

  JointLayout run(const RecordingChoice& choice, const std::string& path) {
    layout_.main = choose_main(topics_, streams_, choice, path);
    const JointStream& main = streams_[layout_.main];
    layout_.of_stream.resize(streams_.size());
    add_time(choice, main);
    const bool are_fields = topics_[main.topic].role == TopicRole::fields;
    const std::vector<int> order =
        are_fields ? std::vector<int>{} : order_joints(main, choice, path, layout_.issues);
    add_stream(layout_.main, has_commanded_torque(order) ? kMeasuredBeside : kMeasured, order);
    for (int s = 0; s < std::ssize(streams_); ++s) {
      layout_.is_rival.push_back(s != layout_.main && is_rival(streams_[s], main));
      if (s == layout_.main) continue;
      if (layout_.columns.size() + kArrays.size() * streams_[s].joints.size() > kMostLogColumns)
        leave_out(s);
      else
        add_other(s, order);
    }
    report_left_out();
    return std::move(layout_);
  }

 private:
  void add_time(const RecordingChoice& choice, const JointStream& main) {
    const bool header = choice.time ? *choice.time == MessageTime::header : main.stamped;
    if (header || main.stamped) add_time_column(layout_.stamp_column, "stamp", header);
    if (!header || main.received_later) add_time_column(layout_.receipt_column, "receipt", !header);
    if (!main.stamped)
      layout_.issues.add({"no_stamps", "t", Severity::note,
                          "the headers of the messages carry no time stamps; unless the robot file sets "
                          "[log] time, the time of receipt is used"});
  }

  void add_time_column(int& place, const char* name, bool is_time) {
    place = static_cast<int>(layout_.columns.size());
    layout_.columns.push_back({name, "s"});
    if (is_time) layout_.columns.back().meaning = Channel{};
  }

  /// Adds a stream other than the main one: commands for the same joints are its references, measured torques
  /// alone are tau_meas, other streams have no meaning.
  void add_other(int s, const std::vector<int>& order) {
    const JointStream& stream = streams_[s];
    const Topic& topic = topics_[stream.topic];
    if (is_computed(topic.name)) return add_nothing(s);
    const std::vector<int> same = same_joints(stream, order);
    const bool torques = stream.has == std::array{false, false, true};
    if (!same.empty() && is_command(topic) && !has_reference_) {
      has_reference_ = true;
      add_stream(s, kCommanded, same);
    } else if (!same.empty() && topic.role == TopicRole::commanded_torque && !has_command_) {
      has_command_ = true;
      add_stream(s, kMeasured, same);
    } else if (!same.empty() && torques && !has_measured_ &&
               parse_name("torque/" + topic.name).quantity == Quantity::tau_meas) {
      has_measured_ = true;
      add_stream(s, kMeasuredBeside, same);
    } else {
      add_stream(s, kMeasured, {});
    }
  }

  /// True for positions, not commanded, of joints on the same topic or with some of the same names.
  bool is_rival(const JointStream& stream, const JointStream& main) const {
    const Topic& topic = topics_[stream.topic];
    if (!stream.has[0] || is_command(topic) || is_computed(topic.name) || topic.name == kExtraTopic ||
        topic.role == TopicRole::fields)
      return false;
    return stream.topic == main.topic || share_a_joint(stream.joints, main.joints);
  }

  /// True when the torques that a controller commands to the joints of the log are a stream of their own, so
  /// that the efforts of the main stream are measured ones.
  bool has_commanded_torque(const std::vector<int>& order) const {
    return std::any_of(streams_.begin(), streams_.end(), [&](const JointStream& stream) {
      return topics_[stream.topic].role == TopicRole::commanded_torque && !same_joints(stream, order).empty();
    });
  }

  void leave_out(int s) {
    add_nothing(s);
    if (left_out_++ == 0) first_left_out_ = topics_[streams_[s].topic].name;
  }

  void report_left_out() {
    if (left_out_ > 0)
      layout_.issues.add(
          {"streams_left_out", "", Severity::warning,
           fmt::format(
               "{} further lists of joints, the first on {}, were left out: a log has at most {} columns",
               left_out_, in_quotes(std::as_const(first_left_out_)), kMostLogColumns)});
  }

  void add_nothing(int s) {
    for (JointColumns& columns : layout_.of_stream[s]) columns.assign(streams_[s].joints.size(), -1);
  }

  /// Returns the joints of the log as indices into the stream; empty when it lacks some.
  std::vector<int> same_joints(const JointStream& stream, const std::vector<int>& order) const {
    std::vector<int> same;
    for (const int j : order) {
      same.push_back(index_of(stream.joints, streams_[layout_.main].joints[j]));
      if (same.back() < 0) return {};
    }
    return same;
  }

  /// Adds the columns of a stream: `joints` are the log's, with the meaning `quantities`, others have none.
  void add_stream(int s, const std::array<Quantity, 3>& quantities, const std::vector<int>& joints) {
    const JointStream& stream = streams_[s];
    for (std::size_t a = 0; a < kArrays.size(); ++a) {
      JointColumns& columns = layout_.of_stream[s][a];
      columns.assign(stream.joints.size(), -1);
      if (!stream.has[a]) continue;
      for (int j = 0; j < std::ssize(joints); ++j)
        add_column(columns[joints[j]], stream, joints[j], kArrays[a], Channel{quantities[a], Joint::at(j)});
      for (int j = 0; j < std::ssize(stream.joints); ++j)
        if (columns[j] < 0) add_column(columns[j], stream, j, kArrays[a], std::nullopt);
    }
  }

  void add_column(int& place, const JointStream& stream, int j, const char* array,
                  std::optional<Channel> meaning) {
    if (place >= 0) return;  // a joint named twice in [log] joints
    place = static_cast<int>(layout_.columns.size());
    RawColumn column = column_of(stream, j, array);
    column.meaning = meaning;
    layout_.columns.push_back(column);
  }

  /// Names a column by topic, joint and array; extra channels written by this program get their own name.
  RawColumn column_of(const JointStream& stream, int j, const char* array) const {
    const std::string &topic = topics_[stream.topic].name, &name = stream.joints[j];
    if (topics_[stream.topic].role == TopicRole::fields) return {topic + "/" + name, ""};
    if (topic != kExtraTopic) return {topic + "/" + name + "/" + array, ""};
    const NameAndUnit parts = split_unit(name);
    return {parts.name, parts.unit};
  }

  const std::vector<Topic>& topics_;
  const std::vector<JointStream>& streams_;
  JointLayout layout_;
  bool has_reference_ = false, has_measured_ = false, has_command_ = false;
  int left_out_ = 0;  ///< streams that would exceed the number of columns
  std::string first_left_out_;
};

}  // namespace

JointLayout layout_joints(const std::vector<Topic>& topics, const std::vector<JointStream>& streams,
                          const RecordingChoice& choice, const std::string& path) {
  return Layouter(topics, streams).run(choice, path);
}

}  // namespace faultline
