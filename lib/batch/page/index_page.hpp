// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lib/batch/batch_row.hpp"
#include "lib/batch/batch_summary.hpp"

namespace faultline {

/// The faults of a run on a bar a joint: pale from onset to alarm, full from alarm to end. Empty for a log
/// without a span of time.
std::string index_thumbnail(const BatchRow& row);

/// One self-contained page over all logs: counts, trends, a row a log with a picture of its timeline, which a
/// small script sorts and filters. Nothing is loaded, and its Content-Security-Policy forbids it. Rows lead
/// to logs/<result>.html with `pages`, else to the JSON.
std::string render_index_page(const std::vector<BatchRow>& rows, const BatchSummary& summary, bool pages);

/// All rows as JSON for the page's scripts, safe inside a <script> element: {pages, time, models[], labels[],
/// parameters[], rows[]}; a row is [log, verdict, model, result, faults, reason, start_s, end_s, period_s,
/// joints, issues, rows, residual_rms[], residual_peak[], condition, parameters], a fault [label, joint,
/// onset_s, alarm_s, end_s, confidence], a condition or parameter [name, value, half of its 95 % interval];
/// models, labels and names by their place in the lists. `time`: all judged logs contain the date.
std::string index_data(const std::vector<BatchRow>& rows, const BatchFacts& facts, bool pages);

/// What is put into every index, embedded when the program is built (embed_assets.cmake).
std::string_view index_style();
std::string_view index_script();

/// How residuals and faults went from log to log: by start time when all logs contain the date, else by name.
/// Many logs share a point, so that no peak is lost. Empty for less than two judged logs.
std::string index_trends(const std::vector<BatchRow>& rows);

/// Whether all judged logs say when they were recorded.
bool all_have_dates(const std::vector<BatchRow>& rows);

}  // namespace faultline
