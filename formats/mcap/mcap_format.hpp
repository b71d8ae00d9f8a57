// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

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

}  // namespace faultline
