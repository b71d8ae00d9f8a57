// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lib/log/log_source.hpp"

namespace faultline {

/// Returns the same log, read a few segments ahead by a thread of its own (if one can be started); memory
/// stays bounded and the segments are the same. identity() and issues() are complete after the last segment.
std::unique_ptr<LogSource> prefetched(std::unique_ptr<LogSource> source);

}  // namespace faultline
