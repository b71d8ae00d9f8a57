// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "formats/mcap/mcap_file.hpp"
#include "formats/mcap/mcap_recording.hpp"

namespace faultline {

/// Where named curves stand in a recording: messages as JSON with a member a name, which can be plotted.
McapTopic curves_topic(const NamedCurves& curves);

/// The values of all curves at a point.
std::string curves_message(std::int64_t stamp_ns, const NamedCurves& curves, std::size_t point);

}  // namespace faultline
