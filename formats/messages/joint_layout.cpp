// SPDX-License-Identifier: MIT
#include "formats/messages/joint_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr std::array kMeasured{Quantity::q, Quantity::dq, Quantity::tau};
constexpr std::array kCommanded{Quantity::q_ref, Quantity::dq_ref, Quantity::tau_ref};
constexpr std::array kArrays{"position", "velocity", "effort"};

std::string quoted(const std::string& name) { return "\"" + shortened(name, kLongestName) + "\""; }

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + quoted(name);
  return text;
}

/// A topic of what the robot was told to do.
bool is_command(const std::string& topic) {
  NameReading reading = read_name("position/" + topic);
  return reading.quantity == Quantity::q_ref;
}

int choose_main(const std::vector<Topic>& topics, const std::vector<JointStream>& streams,
                const RecordingChoice& choice, const std::string& path) {
  const auto name_of = [&](const JointStream& stream) { return topics[stream.topic].name; };
  const auto rank = [&](const JointStream& stream) {
    return std::tuple(stream.position, !is_command(name_of(stream)),
                      name_of(stream).find("joint_states") != std::string::npos, stream.effort,
                      stream.messages);
  };
  int best = -1;
  for (int s = 0; s < std::ssize(streams); ++s) {
    if (!choice.topic.empty() && name_of(streams[s]) != choice.topic) continue;
    if (best < 0 || rank(streams[s]) > rank(streams[best])) best = s;
  }
  if (best >= 0) return best;
  std::set<std::string> names;
  for (const JointStream& stream : streams) names.insert(name_of(stream));
  throw Error(ErrorCode::input, path,
              "has no topic " + quoted(choice.topic) +
                  " with joint states, which the robot file names as [log] topic; there are " +
                  listed({names.begin(), names.end()}));
}

/// Joints whose names differ by a number only stand in the order of the numbers; empty when they do not.
std::vector<int> numbered_order(const std::vector<std::string>& joints) {
  std::vector<std::pair<int, int>> numbered;
  std::set<std::string> stems;
  std::set<int> numbers;
  for (int j = 0; j < std::ssize(joints); ++j) {
    const NameReading reading = read_name(joints[j]);
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

/// The joints of the log, base to tip, as indices of the main stream's.
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
           "the joints are taken in the order of the messages: " + listed(stream.joints) +
               ". If that is not from base to tip, name them in the robot file: [log] joints = [...]"});
    return order;
  }
  for (const std::string& joint : choice.joints) {
    const auto found = std::find(stream.joints.begin(), stream.joints.end(), joint);
    if (found == stream.joints.end())
      throw Error(ErrorCode::input, path,
                  "has no joint " + quoted(joint) +
                      ", which the robot file names in [log] joints; there are " + listed(stream.joints));
    order.push_back(static_cast<int>(found - stream.joints.begin()));
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
    add_time(choice, main.stamped);
    const std::vector<int> order = order_joints(main, choice, path, layout_.issues);
    add_stream(layout_.main, kMeasured, order);
    for (int s = 0; s < std::ssize(streams_); ++s)
      if (s != layout_.main) add_other(s, order);
    return std::move(layout_);
  }

 private:
  void add_time(const RecordingChoice& choice, bool stamped) {
    const bool header = choice.time ? *choice.time == MessageTime::header : stamped;
    layout_.columns.push_back({"stamp", "s"});
    layout_.columns.push_back({"receipt", "s"});
    layout_.columns[header ? layout_.stamp_column : layout_.receipt_column].meaning = Channel{};
    if (!stamped)
      layout_.issues.add({"no_stamps", "t", Severity::note,
                          "the messages bear no stamps; the time is that of their receipt"});
  }

  /// A stream of commands for the same joints is the reference of the main one.
  void add_other(int s, const std::vector<int>& order) {
    const JointStream& main = streams_[layout_.main];
    std::vector<int> matching;
    for (const int joint : order) {
      const auto& joints = streams_[s].joints;
      const auto found = std::find(joints.begin(), joints.end(), main.joints[joint]);
      if (found != joints.end()) matching.push_back(static_cast<int>(found - joints.begin()));
    }
    const bool reference = !has_reference_ && matching.size() == order.size() && !order.empty() &&
                           is_command(topics_[streams_[s].topic].name);
    has_reference_ = has_reference_ || reference;
    add_stream(s, kCommanded, reference ? matching : std::vector<int>{});
  }

  /// Columns of a stream: `joints` are the log's, with the meaning `quantities`, others have none.
  void add_stream(int s, const std::array<Quantity, 3>& quantities, const std::vector<int>& joints) {
    const JointStream& stream = streams_[s];
    const std::array<bool, 3> there{stream.position, stream.velocity, stream.effort};
    for (std::size_t a = 0; a < kArrays.size(); ++a) {
      JointColumns& columns = layout_.of_stream[s][a];
      columns.assign(stream.joints.size(), -1);
      if (!there[a]) continue;
      for (int j = 0; j < std::ssize(joints); ++j)
        add_column(columns[joints[j]], stream, joints[j], kArrays[a], Channel{quantities[a], j + 1});
      for (int j = 0; j < std::ssize(stream.joints); ++j)
        if (columns[j] < 0) add_column(columns[j], stream, j, kArrays[a], std::nullopt);
    }
  }

  void add_column(int& place, const JointStream& stream, int joint, const char* array,
                  std::optional<Channel> meaning) {
    if (place >= 0) return;  // a joint named twice in [log] joints
    place = static_cast<int>(layout_.columns.size());
    RawColumn column{topics_[stream.topic].name + "/" + stream.joints[joint] + "/" + array, ""};
    column.meaning = meaning;
    layout_.columns.push_back(column);
  }

  const std::vector<Topic>& topics_;
  const std::vector<JointStream>& streams_;
  JointLayout layout_;
  bool has_reference_ = false;
};

}  // namespace

JointLayout layout_joints(const std::vector<Topic>& topics, const std::vector<JointStream>& streams,
                          const RecordingChoice& choice, const std::string& path) {
  return Layouter(topics, streams).run(choice, path);
}

}  // namespace faultline
