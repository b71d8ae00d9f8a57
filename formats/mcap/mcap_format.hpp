// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "formats/byte_source.hpp"
#include "formats/log_writer.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

bool looks_like_mcap(std::string_view head);

/// Opens the joint states of an MCAP recording, read from front to back; its index is only checked.
std::unique_ptr<RawReader> open_mcap(std::unique_ptr<ByteSource> bytes);

/// Name of the metadata that hold provenance_of(), and its key.
inline constexpr const char* kMcapProvenance = "faultline/provenance";
inline constexpr const char* kMcapProvenanceKey = "json";

/// Creates a recording of sensor_msgs/JointState messages of ROS 2, which Foxglove and PlotJuggler open.
/// Times are written in whole nanoseconds and cannot be before 0.
std::unique_ptr<LogWriter> create_mcap(const std::string& path);

/// Signals of the joints that were computed from a log, under a topic of their own.
struct ComputedSignals {
  std::string topic;
  JointSignals position, velocity, effort;  ///< joints x ComputedRows::row; empty for missing ones
};

/// Results that were computed from rows of a segment.
struct ComputedRows {
  std::vector<int> row;  ///< of the segment, ascending
  std::vector<ComputedSignals> signals;
};

/// Named values over time, under a topic of their own.
struct NamedCurves {
  std::string topic;
  std::vector<std::string> names;
  std::vector<double> time;                 ///< s
  std::vector<std::vector<double>> values;  ///< names x time; NaN for missing values
};

/// Writes a log and the results computed from it as MCAP. Topics have the names in message_source.hpp.
class McapRecording : public LogWriter {
 public:
  using LogWriter::write;
  /// Writes a segment, each row with the results computed from it.
  virtual void write(const Log& segment, const ComputedRows& computed) = 0;
  /// Writes JSON messages, with null for NaN. Call it after all rows.
  virtual void write(const NamedCurves& curves) = 0;
  /// Writes a text under a name and the key "json", which programs show as metadata. Call it after all rows.
  virtual void note(const std::string& name, const std::string& json) = 0;
};

std::unique_ptr<McapRecording> create_mcap_recording(const std::string& path);

}  // namespace faultline
