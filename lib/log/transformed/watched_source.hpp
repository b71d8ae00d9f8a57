// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

#include "lib/log/log_source.hpp"

namespace faultline {

/// Returns the log; each segment that is read from it calls `watch` with share_read(): 0 to 1, NaN if
/// unknown. What `watch` throws ends the reading.
std::unique_ptr<LogSource> watched_log(std::unique_ptr<LogSource> log, std::function<void(double)> watch);

}  // namespace faultline
