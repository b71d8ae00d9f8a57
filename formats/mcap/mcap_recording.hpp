// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "formats/log_writer.hpp"

namespace faultline {

/// Name of the metadata that hold provenance_of(), and its key.
inline constexpr const char* kMcapProvenance = "faultline/provenance";
inline constexpr const char* kMcapProvenanceKey = "json";

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
