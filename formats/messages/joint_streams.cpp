// SPDX-License-Identifier: MIT
#include "formats/messages/joint_streams.hpp"

#include <algorithm>
#include <utility>

namespace faultline {
namespace {

/// Largest number of lists of names that are distinguished in one file; a recording has a few.
constexpr std::size_t kMostPatterns = 256;
constexpr std::size_t kMostJoints = 256;
constexpr std::size_t kMostNameBytes = 1 << 15;  ///< bytes of the names in a message

void add_to(JointStream& stream, const JointStream& more) {
  for (const std::string& joint : more.joints)
    if (stream.joints.size() < kMostJoints && index_of(stream.joints, joint) < 0)
      stream.joints.push_back(joint);
  stream.messages += more.messages;
  for (std::size_t a = 0; a < stream.has.size(); ++a) stream.has[a] = stream.has[a] || more.has[a];
  stream.stamped = stream.stamped || more.stamped;
  stream.received_later = stream.received_later || more.received_later;
}

/// Returns the names of the joints; joints of messages without names are numbered from 1.
std::vector<std::string> names_in(const JointMessage& state, const JointStateDecoder& decoder) {
  std::vector<std::string> names = decoder.decode_names(state);
  if (!names.empty()) return names;
  std::size_t joints = 0;
  for (const PackedNumbers& array : state.arrays) joints = std::max(joints, array.count);
  for (std::size_t j = 1; j <= std::min(joints, kMostJoints); ++j) names.push_back(std::to_string(j));
  return names;
}

}  // namespace

int index_of(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

bool share_a_joint(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return std::any_of(a.begin(), a.end(), [&](const std::string& name) { return index_of(b, name) >= 0; });
}

JointStateDecoder* JointStreams::decoder_of(const Topic& topic, int index) {
  const auto at = static_cast<std::size_t>(index);
  if (at >= readers_.size()) readers_.resize(at + 1);
  TopicReader& reader = readers_[at];
  if (!reader.asked && (is_joint_state(topic.type) || topic.role == TopicRole::fields))
    reader.decoder = joint_state_decoder(topic.encoding);
  reader.asked = true;
  return reader.decoder.get();
}

JointStreams::Pattern* JointStreams::pattern_of(int topic, const JointMessage& state,
                                                const JointStateDecoder& decoder) {
  Pattern*& last = readers_[static_cast<std::size_t>(topic)].last;
  if (last && last->encoded == state.names) return last;
  if (state.names.size() > kMostNameBytes) return nullptr;
  std::string key = std::to_string(topic) + ' ';
  key += state.names;
  if (const auto known = pattern_of_.find(key); known != pattern_of_.end()) return last = &known->second;
  if (patterns_.size() == kMostPatterns) return nullptr;
  last = &pattern_of_[key];
  *last = {topic, std::string(state.names), names_in(state, decoder), {}, {}};
  if (settled_) place(*last);
  patterns_.push_back(last);
  return last;
}

bool JointStreams::learn(const Topic& topic, const Message& message) {
  JointStateDecoder* decoder = decoder_of(topic, message.topic);
  JointMessage state;
  if (!decoder || !decoder->decode(message.bytes, state)) return false;
  Pattern* pattern = pattern_of(message.topic, state, *decoder);
  if (!pattern || pattern->names.empty() || pattern->names.size() > kMostJoints) return false;
  JointStream met{
      message.topic, pattern->names, 1, {}, state.stamp_ns != 0, state.stamp_ns != message.receipt_ns};
  for (std::size_t a = 0; a < met.has.size(); ++a) met.has[a] = state.arrays[a].count > 0;
  add_to(pattern->counted, met);
  return true;
}

/// Adds a pattern to the streams; streams that share joints with it are merged.
void JointStreams::join(const Pattern& pattern) {
  if (pattern.counted.messages == 0) return;
  JointStream joined = pattern.counted;
  joined.topic = pattern.topic;
  std::vector<JointStream> apart;
  std::size_t place = streams_.size();
  for (const JointStream& stream : streams_) {
    if (stream.topic != pattern.topic || !share_a_joint(stream.joints, pattern.names)) {
      apart.push_back(stream);
      continue;
    }
    JointStream earlier = stream;
    add_to(earlier, joined);
    joined = earlier;
    place = std::min(place, apart.size());
  }
  apart.insert(apart.begin() + static_cast<std::ptrdiff_t>(std::min(place, apart.size())), joined);
  streams_ = std::move(apart);
}

void JointStreams::place(Pattern& pattern) const {
  JointPlacing& placing = pattern.placing;
  placing = {};
  placing.joint_of.assign(pattern.names.size(), -1);
  for (std::size_t s = 0; s < streams_.size() && placing.stream < 0; ++s)
    if (streams_[s].topic == pattern.topic && share_a_joint(streams_[s].joints, pattern.names))
      placing.stream = static_cast<int>(s);
  if (placing.stream < 0) return;
  const std::vector<std::string>& joints = streams_[placing.stream].joints;
  placing.is_present.assign(joints.size(), false);
  for (std::size_t i = 0; i < pattern.names.size(); ++i) {
    const int joint = index_of(joints, pattern.names[i]);
    if (joint < 0 || placing.is_present[joint]) continue;  // unknown, or named twice
    placing.joint_of[i] = joint;
    placing.is_present[joint] = true;
  }
  const auto all = [](const auto& values, auto holds) {
    return std::all_of(values.begin(), values.end(), holds);
  };
  placing.complete = all(placing.joint_of, [](int j) { return j >= 0; }) &&
                     all(placing.is_present, [](bool present) { return present; });
}

void JointStreams::settle() {
  for (const Pattern* pattern : patterns_) join(*pattern);
  for (Pattern* pattern : patterns_) place(*pattern);
  settled_ = true;
}

const JointPlacing* JointStreams::read(const Topic& topic, const Message& message, JointMessage& state,
                                       bool& damaged) {
  damaged = false;
  JointStateDecoder* decoder = decoder_of(topic, message.topic);
  if (!decoder) return nullptr;
  damaged = !decoder->decode(message.bytes, state);
  if (damaged) return nullptr;
  static const JointPlacing kNowhere;
  const Pattern* pattern = pattern_of(message.topic, state, *decoder);
  return pattern ? &pattern->placing : &kNowhere;
}

}  // namespace faultline
