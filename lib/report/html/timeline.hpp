// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/diagnose/diagnosis.hpp"

namespace faultline {

/// The run from left to right, a lane a joint, as an SVG whose text keeps its size; each fault is a link to
/// "#fault-ID" that names its kind and times. Empty when the log has no span of time.
std::string html_timeline(const Diagnosis& diagnosis);

}  // namespace faultline
