// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/batch/batch_row.hpp"

/// Parts of a batch's index page.
namespace faultline {

/// The table of logs, a row each.
std::string index_table(const std::vector<BatchRow>& rows, bool pages);

/// The faults of a run on a bar a joint: pale from onset to alarm, full from alarm to end. Empty for a log
/// without a span of time.
std::string index_thumbnail(const BatchRow& row);

/// How residuals and faults went from log to log: by start time when all logs tell the date, else by name.
/// Many logs share a point, so that no peak is lost. Empty for less than two judged logs.
std::string index_trends(const std::vector<BatchRow>& rows);

}  // namespace faultline
