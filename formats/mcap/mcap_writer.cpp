// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "formats/known_formats.hpp"
#include "formats/log_writer.hpp"
#include "formats/mcap/mcap_file.hpp"
#include "formats/mcap/mcap_recording.hpp"
#include "formats/messages/encode_joint_state.hpp"
#include "formats/messages/message_source.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

/// Returns a time as a member of a JSON message, in the form that programs recognise, and its schema.
nlohmann::ordered_json mcap_stamp(std::int64_t stamp_ns) {
  constexpr std::int64_t kNsPerSecond = 1'000'000'000;
  return {{"sec", stamp_ns / kNsPerSecond}, {"nsec", stamp_ns % kNsPerSecond}};
}

nlohmann::ordered_json mcap_stamp_schema() {
  const nlohmann::ordered_json integer{{"type", "integer"}};
  return {{"type", "object"}, {"title", "time"}, {"properties", {{"sec", integer}, {"nsec", integer}}}};
}

using Json = nlohmann::ordered_json;

/// Largest number of seconds of a stamp: 32 bits with sign.
constexpr double kMostSeconds = 2147483647.0;
/// Levels of foxglove.Log.
constexpr int kInfo = 2, kError = 4;

/// Positions, velocities and efforts of joints; null for signals that there are not.
using StateSignals = std::array<const JointSignals*, 3>;

/// A topic of joint states, and the signals of a log that it holds.
struct StatesTopic {
  const char* name;
  std::array<const JointSignals Log::*, 3> members;

  StateSignals signals_of(const Log& log) const {
    StateSignals signals{};
    for (std::size_t a = 0; a < members.size(); ++a)
      if (members[a] && !(log.*members[a]).empty()) signals[a] = &(log.*members[a]);
    return signals;
  }
};
/// Commands come before the states of the same time, so that they are available when the states are read.
const StatesTopic kTopics[] = {{kCommandsTopic, {&Log::q_ref, &Log::dq_ref, &Log::tau_ref}},
                               {kMeasuredTopic, {nullptr, nullptr, &Log::tau_meas}},
                               {kStatesTopic, {&Log::q, &Log::dq, &Log::tau}}};

std::vector<std::string> joint_names(int joints) {
  std::vector<std::string> names;
  for (int j = 0; j < joints; ++j) names.push_back(fmt::format("joint{}", Joint::at(j)));
  return names;
}

std::vector<std::string> extra_names(const Log& log) {
  std::vector<std::string> names;
  for (const ExtraChannel& extra : log.extra)
    names.push_back(extra.unit.empty() ? extra.name : extra.name + " [" + extra.unit + "]");
  return names;
}

/// Returns the topic of named curves: JSON messages with a member per name, which can be plotted.
McapTopic curves_topic(const NamedCurves& curves) {
  Json members{{"timestamp", mcap_stamp_schema()}};
  for (const std::string& name : curves.names) members[name] = {{"type", Json::array({"number", "null"})}};
  const Json schema{{"title", curves.topic}, {"type", "object"}, {"properties", members}};
  return {curves.topic, curves.topic.substr(1), "jsonschema", schema.dump(), "json"};
}

/// Returns the values of all curves at a point.
std::string curves_message(std::int64_t stamp_ns, const NamedCurves& curves, std::size_t point) {
  Json message{{"timestamp", mcap_stamp(stamp_ns)}};
  for (std::size_t i = 0; i < curves.names.size(); ++i) {
    const double value = curves.values[i][point];
    message[curves.names[i]] = std::isfinite(value) ? Json(value) : Json(nullptr);
  }
  return message.dump();
}

/// Returns the topic of events: messages of type foxglove.Log as JSON, which Foxglove lists by their times.
McapTopic event_topic() {
  const Json integer{{"type", "integer"}}, text{{"type", "string"}};
  const Json schema{{"title", "foxglove.Log"},
                    {"type", "object"},
                    {"properties",
                     {{"timestamp", mcap_stamp_schema()},
                      {"level", integer},
                      {"message", text},
                      {"name", text},
                      {"file", text},
                      {"line", integer}}}};
  return {"/faultline/diagnosis", "foxglove.Log", "jsonschema", schema.dump(), "json"};
}

std::string event_message(std::int64_t stamp_ns, const LogEvent& event) {
  return Json{{"timestamp", mcap_stamp(stamp_ns)},
              {"level", event.grave ? kError : kInfo},
              {"message", event.text},
              {"name", "faultline"},
              {"file", ""},
              {"line", 0}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

class McapWriter : public McapRecording {
 public:
  explicit McapWriter(const std::string& path) : path_(path), file_(path) {}

  void write(const Log& segment) override { write(segment, {}); }

  void write(const Log& segment, const ComputedRows& computed) override {
    if (!states_) begin(segment);
    std::size_t next = 0;
    for (int row = 0; row < segment.rows(); ++row) {
      write_row(segment, row);
      for (; next < computed.row.size() && computed.row[next] == row; ++next)
        write_computed(computed.signals, next, stamp_of(segment.time[row]));
    }
  }

  void write(const NamedCurves& curves) override {
    const std::uint16_t channel = file_.add_topic(curves_topic(curves));
    for (std::size_t point = 0; point < curves.time.size(); ++point) {
      const std::int64_t stamp = stamp_of(curves.time[point]);
      file_.message(channel, static_cast<std::uint64_t>(stamp), curves_message(stamp, curves, point));
    }
  }

  void note(const std::string& name, const std::string& json) override {
    file_.metadata(name, kMcapProvenanceKey, json);
  }

  void note_provenance(const std::string& provenance) override {
    file_.metadata(kMcapProvenance, kMcapProvenanceKey, provenance);
  }

  bool note_events(const std::vector<LogEvent>& events) override {
    const std::uint16_t channel = file_.add_topic(event_topic());
    for (const LogEvent& event : events) {
      const std::int64_t stamp = stamp_of(event.time_s);
      file_.message(channel, static_cast<std::uint64_t>(stamp), event_message(stamp, event));
    }
    return true;
  }

  void commit() override { file_.finish(); }

 private:
  void begin(const Log& log) {
    states_.emplace(joint_names(log.joints()));
    for (const StatesTopic& topic : kTopics)
      channels_.push_back(topic.signals_of(log) == StateSignals{} ? std::uint16_t{0} : add_topic(topic.name));
    if (log.extra.empty()) return;
    extra_.emplace(extra_names(log));
    extra_channel_ = add_topic(kExtraTopic);
  }

  std::uint16_t add_topic(const std::string& name) {
    return file_.add_topic(
        {name, JointStateEncoder::kType, "ros2msg", JointStateEncoder::kDefinition, "cdr"});
  }

  void write_computed(const std::vector<ComputedSignals>& signals, std::size_t at, std::int64_t stamp) {
    for (const ComputedSignals& computed : signals) {
      auto channel = computed_channels_.find(computed.topic);
      if (channel == computed_channels_.end())
        channel = computed_channels_.emplace(computed.topic, add_topic(computed.topic)).first;
      put_states(channel->second, stamp, {&computed.position, &computed.velocity, &computed.effort}, at);
    }
  }

  void write_row(const Log& log, int row) {
    const std::int64_t stamp = stamp_of(log.time[row]);
    if (extra_) {
      row_ = {};
      for (const ExtraChannel& extra : log.extra) row_[0].push_back(extra.values[row]);
      put(*extra_, extra_channel_, stamp);
    }
    for (std::size_t i = 0; i < std::size(kTopics); ++i)
      if (channels_[i] != 0)
        put_states(channels_[i], stamp, kTopics[i].signals_of(log), static_cast<std::size_t>(row));
  }

  void put_states(std::uint16_t channel, std::int64_t stamp, const StateSignals& signals, std::size_t row) {
    for (std::size_t a = 0; a < signals.size(); ++a) {
      row_[a].clear();
      if (signals[a])
        for (const std::vector<double>& joint : *signals[a]) row_[a].push_back(joint[row]);
    }
    put(*states_, channel, stamp);
  }

  /// Converts a time of the log to ns.
  std::int64_t stamp_of(double time) const {
    if (!(time >= 0.0 && time < kMostSeconds))
      throw Error(
          ErrorCode::output, path_,
          fmt::format("cannot hold the time {} s: stamps of messages lie between 0 and {} s; write .csv or "
                      ".flog, or shift the clock of the log to start at 0",
                      time, kMostSeconds));
    // Seconds and fraction are converted separately, so that a time since 1970 keeps its bits.
    const double seconds = std::floor(time);
    return static_cast<std::int64_t>(seconds) * 1'000'000'000 + std::llround((time - seconds) * 1e9);
  }

  void put(const JointStateEncoder& encoder, std::uint16_t channel, std::int64_t stamp) {
    message_.clear();
    encoder.append(stamp, row_, message_);
    file_.message(channel, static_cast<std::uint64_t>(stamp), message_);
  }

  std::string path_;
  McapFile file_;
  std::optional<JointStateEncoder> states_, extra_;
  std::vector<std::uint16_t> channels_;  ///< by kTopics; 0 for topics that the log lacks
  std::uint16_t extra_channel_ = 0;
  std::map<std::string, std::uint16_t> computed_channels_;  ///< by topic
  JointRow row_;
  std::string message_;
};

}  // namespace

std::unique_ptr<LogWriter> create_mcap(const std::string& path) { return std::make_unique<McapWriter>(path); }

std::unique_ptr<McapRecording> create_mcap_recording(const std::string& path) {
  return std::make_unique<McapWriter>(path);
}

}  // namespace faultline
