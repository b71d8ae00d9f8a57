// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/batch/batch_row.hpp"

namespace faultline {

/// Where the scripts put the table of logs, and for readers without them a plain one: a row each, which leads
/// to logs/<result>.html with `pages`, else to the JSON.
std::string index_table(const std::vector<BatchRow>& rows, bool pages);

}  // namespace faultline
