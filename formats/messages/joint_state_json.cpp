// SPDX-License-Identifier: MIT
#include "formats/messages/joint_state_json.hpp"

#include <nlohmann/json.hpp>

#include "formats/missing.hpp"

namespace faultline {
namespace {

using MessageJson = nlohmann::json;

constexpr std::int64_t kStateNanoseconds = 1'000'000'000;
/// Of a stamp; more would not fit 64 bits of nanoseconds.
constexpr double kStateMostSeconds = 9e9;
/// Bytes of a message; parsed, it takes many times as much memory.
constexpr std::size_t kLongestJson = 1 << 20;

/// The first of the members that is a number; 0 for none.
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
  return static_cast<std::int64_t>(seconds) * kStateNanoseconds + static_cast<std::int64_t>(nanoseconds);
}

/// A member that is an array of numbers; what is no number in it (such as null) is NaN.
bool take_numbers(const MessageJson& message, const char* name, std::vector<double>& numbers) {
  numbers.clear();
  const auto found = message.find(name);
  if (found == message.end() || found->is_null()) return true;
  if (!found->is_array()) return false;
  for (const MessageJson& value : *found) numbers.push_back(value.is_number() ? value.get<double>() : kNan);
  return true;
}

PackedNumbers packed(const std::vector<double>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size(), false};
}

class JsonDecoder : public JointStateDecoder {
 public:
  bool decode(std::string_view bytes, JointMessage& state) override {
    if (bytes.size() > kLongestJson) return false;
    const MessageJson message = MessageJson::parse(bytes, nullptr, false);
    if (!message.is_object()) return false;
    if (!take_names(message)) return false;
    if (!take_numbers(message, "position", position_) || !take_numbers(message, "velocity", velocity_) ||
        !take_numbers(message, "effort", effort_))
      return false;
    state = {stamp_of(message), names_text_, packed(position_), packed(velocity_), packed(effort_)};
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
  std::vector<double> position_, velocity_, effort_;
};

}  // namespace

std::unique_ptr<JointStateDecoder> json_joint_state_decoder() { return std::make_unique<JsonDecoder>(); }

}  // namespace faultline
