// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "formats/log_event.hpp"
#include "formats/mcap/mcap_file.hpp"

namespace faultline {

/// Where events stand in a recording: messages of type foxglove.Log as JSON, which Foxglove lists by their
/// times.
McapTopic event_topic();

std::string event_message(std::int64_t stamp_ns, const LogEvent& event);

}  // namespace faultline
