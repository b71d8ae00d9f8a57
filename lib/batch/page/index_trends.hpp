// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/batch/batch_row.hpp"

namespace faultline {

/// How residuals and faults went from log to log: by start time when all logs tell the date, else by name.
/// Many logs share a point, so that no peak is lost. Empty for less than two judged logs.
std::string index_trends(const std::vector<BatchRow>& rows);

/// Whether all judged logs say when they were recorded.
bool all_have_dates(const std::vector<BatchRow>& rows);

}  // namespace faultline
