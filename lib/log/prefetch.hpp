// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lib/log/log_source.hpp"

namespace faultline {

/// The same log, read by a thread of its own (where one can be started) a few segments ahead of who takes
/// them; memory stays bounded, and what comes out is the same. identity() and issues() are complete after the
/// last segment.
std::unique_ptr<LogSource> prefetched(std::unique_ptr<LogSource> source);

}  // namespace faultline
