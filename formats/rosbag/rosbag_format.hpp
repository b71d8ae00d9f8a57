// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string_view>

#include "formats/byte_source.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

bool looks_like_rosbag1(std::string_view head);

/// Opens the joint states of a ROS 1 bag, version 2.0, read from front to back.
std::unique_ptr<RawReader> open_rosbag1(std::unique_ptr<ByteSource> bytes);

bool looks_like_rosbag2(std::string_view head);

/// Opens the joint states of a rosbag2 recording in SQLite by number; Error(input) for a compressed file.
std::unique_ptr<RawReader> open_rosbag2(std::unique_ptr<ByteSource> bytes);

}  // namespace faultline
