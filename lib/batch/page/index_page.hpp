// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/batch/batch_summary.hpp"

namespace faultline {

/// One self-contained page over all logs: counts, trends, a row a log with a picture of its timeline, which a
/// small script sorts and filters. Nothing is loaded, and its Content-Security-Policy forbids it. Rows lead
/// to logs/<result>.html with `pages`, else to the JSON.
std::string render_index_page(const std::vector<BatchRow>& rows, const BatchSummary& summary, bool pages);

}  // namespace faultline
