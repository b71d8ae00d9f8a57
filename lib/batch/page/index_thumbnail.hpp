// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/batch/batch_row.hpp"

namespace faultline {

/// The faults of a run on a bar a joint: pale from onset to alarm, full from alarm to end. Empty for a log
/// without a span of time.
std::string index_thumbnail(const BatchRow& row);

}  // namespace faultline
