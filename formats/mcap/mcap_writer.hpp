// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "formats/log_writer.hpp"

namespace faultline {

/// Name of the metadata that hold provenance_of(), and its key.
inline constexpr const char* kMcapProvenance = "faultline/provenance";
inline constexpr const char* kMcapProvenanceKey = "json";

/// Creates a recording of sensor_msgs/JointState messages of ROS 2, which Foxglove and PlotJuggler open.
/// Times are written in whole nanoseconds and cannot be before 0.
std::unique_ptr<LogWriter> create_mcap(const std::string& path);

}  // namespace faultline
