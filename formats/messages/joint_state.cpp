// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>

#include "formats/messages/joint_streams.hpp"
#include "formats/messages/message_bytes.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {
namespace {

using MessageJson = nlohmann::json;

constexpr std::int64_t kNanoseconds = 1'000'000'000;
constexpr std::size_t kDoubleBytes = sizeof(double);
/// Upper limit of a stamp; more seconds would not fit 64 bits of nanoseconds.
constexpr double kStateMostSeconds = 9e9;
/// Largest message in bytes; parsed, it takes many times as much memory.
constexpr std::size_t kLongestJson = 1 << 20;

/// Decodes messages of ROS 1, and those of ROS 2 after four bytes that give their byte order.
class RosDecoder : public JointStateDecoder {
 public:
  explicit RosDecoder(bool cdr) : cdr_(cdr) {}

  bool decode(std::string_view bytes, JointMessage& state) override {
    const std::optional<MessageWire> wire = cdr_ ? cdr_wire(bytes) : ros1_wire();
    if (!wire) return false;
    MessageBytes members(bytes, *wire);
    if (!cdr_) members.number<std::uint32_t>();  // the number of the message
    // Seconds are signed in ROS 2, but never negative.
    const std::int64_t seconds = members.number<std::uint32_t>();
    state.stamp_ns = seconds * kNanoseconds + members.number<std::uint32_t>();
    members.text();  // the frame
    members.align(sizeof(std::uint32_t));
    const std::size_t begin = members.position();
    if (members.ok() && !members.passes(last_names_)) {
      const auto count = members.number<std::uint32_t>();
      for (std::uint32_t i = 0; i < count && members.ok(); ++i) members.text();
      if (members.ok()) last_names_.assign(bytes.substr(begin, members.position() - begin));
    }
    state.names = bytes.substr(begin, members.position() - begin);
    for (PackedNumbers& array : state.arrays) {
      const std::size_t count = members.number<std::uint32_t>();
      array = {members.values(count, kDoubleBytes).data(), count, wire->swapped};
    }
    last_wire_ = *wire;
    return members.ok();
  }

  std::vector<std::string> decode_names(const JointMessage& state) const override {
    MessageWire wire = last_wire_;
    wire.begin = 0;  // they begin aligned
    MessageBytes members(state.names, wire);
    const auto count = members.number<std::uint32_t>();
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < count && members.ok(); ++i) names.emplace_back(members.text());
    return names;
  }

 private:
  bool cdr_;
  std::string last_names_;  ///< of the message before, encoded
  MessageWire last_wire_;
};

/// Returns the first of the members that is a number; 0 for none.
double number_of(const MessageJson& object, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (const auto found = object.find(name); found != object.end() && found->is_number())
      return found->get<double>();
  return 0.0;
}

std::int64_t stamp_of(const MessageJson& message) {
  const auto header = message.find("header");
  if (header == message.end() || !header->is_object()) return 0;
  const auto stamp = header->find("stamp");
  if (stamp == header->end() || !stamp->is_object()) return 0;
  const double seconds = number_of(*stamp, {"sec", "secs"});
  const double nanoseconds = number_of(*stamp, {"nsec", "nanosec", "nsecs"});
  if (!(seconds >= 0.0 && seconds < kStateMostSeconds && nanoseconds >= 0.0 &&
        nanoseconds < kStateMostSeconds))
    return 0;
  return static_cast<std::int64_t>(seconds) * kNanoseconds + static_cast<std::int64_t>(nanoseconds);
}

/// Reads a member that is an array of numbers; any other element (such as null) is NaN.
bool take_numbers(const MessageJson& message, const char* name, std::vector<double>& numbers) {
  numbers.clear();
  const auto found = message.find(name);
  if (found == message.end() || found->is_null()) return true;
  if (!found->is_array()) return false;
  for (const MessageJson& value : *found) numbers.push_back(value.is_number() ? value.get<double>() : kNan);
  return true;
}

/// Decodes JSON objects with the members of the ROS message; the stamp's nanoseconds are "nsec", "nanosec" or
/// "nsecs", its seconds "sec" or "secs".
class JsonDecoder : public JointStateDecoder {
 public:
  bool decode(std::string_view bytes, JointMessage& state) override {
    if (bytes.size() > kLongestJson) return false;
    const MessageJson message = MessageJson::parse(bytes, nullptr, false);
    if (!message.is_object()) return false;
    if (!take_names(message)) return false;
    state.stamp_ns = stamp_of(message);
    state.names = names_text_;
    constexpr std::array kNames{"position", "velocity", "effort"};
    for (std::size_t a = 0; a < kNames.size(); ++a) {
      if (!take_numbers(message, kNames[a], arrays_[a])) return false;
      state.arrays[a] = {reinterpret_cast<const char*>(arrays_[a].data()), arrays_[a].size(), false};
    }
    return true;
  }

  std::vector<std::string> decode_names(const JointMessage&) const override { return names_; }

 private:
  bool take_names(const MessageJson& message) {
    names_.clear();
    names_text_.clear();
    const auto found = message.find("name");
    if (found == message.end() || found->is_null()) return true;
    if (!found->is_array()) return false;
    for (const MessageJson& name : *found) {
      if (!name.is_string()) return false;
      names_.push_back(name.get<std::string>());
      names_text_ += std::to_string(names_.back().size()) + ":" + names_.back();
    }
    return true;
  }

  std::vector<std::string> names_;
  std::string names_text_;
  std::array<std::vector<double>, 3> arrays_;
};

}  // namespace

double PackedNumbers::operator[](std::size_t i) const {
  std::array<char, kDoubleBytes> raw;
  std::memcpy(raw.data(), data + i * kDoubleBytes, kDoubleBytes);
  if (swapped) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<double>(raw);
}

bool is_joint_state(std::string_view type) {
  return type == "sensor_msgs/JointState" || type == "sensor_msgs/msg/JointState" ||
         type == "sensor_msgs::msg::JointState" || type == "sensor_msgs.JointState" || type == "JointState";
}

std::unique_ptr<JointStateDecoder> joint_state_decoder(std::string_view encoding) {
  if (encoding == "cdr") return std::make_unique<RosDecoder>(true);
  if (encoding == "ros1" || encoding == "ros1msg") return std::make_unique<RosDecoder>(false);
  if (encoding == "json") return std::make_unique<JsonDecoder>();
  return nullptr;
}

}  // namespace faultline
