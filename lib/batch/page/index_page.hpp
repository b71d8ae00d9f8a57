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

/// Rows that stand in the page as they are, also for readers without scripts; more would cost those who have
/// them.
inline constexpr std::size_t kIndexFirstRows = 500;

/// The rows of a batch for the scripts of its page, in parts of columns. A part is an object of arrays with a
/// value for each of its rows: log, verdict, result, reason, doubt, model, start (s), end (s), period (s),
/// joints, issues, count (rows of the log); rms and peak (such an array for each joint); condition and
/// parameters ({name: [values, halves of their 95 % intervals]}); and of faults[]: [row, label, joint,
/// onset_s, alarm_s, end_s, confidence]. Models, labels and names of parameters are named by their place in
/// lists.
struct IndexData {
  /// {pages, time, logs, models[], labels[], parameters[], first} as JSON, safe inside a <script> element.
  /// `time`: all judged logs contain the date. A label is [kind, words]. `first`: the part of the first
  /// kIndexFirstRows rows.
  std::string facts;
  std::vector<std::string> parts;  ///< the others, packed()
};
IndexData index_data(const std::vector<BatchRow>& rows, const BatchFacts& facts, bool pages);

/// What is put into every index, embedded when the program is built (embed_assets.cmake).
std::string_view index_style();
std::string_view index_script();

/// How residuals and faults went from log to log: by start time when all logs contain the date, else by name.
/// Many logs share a point, so that no peak is lost. Empty for less than two judged logs.
std::string index_trends(const std::vector<BatchRow>& rows);

/// Whether all judged logs say when they were recorded.
bool all_have_dates(const std::vector<BatchRow>& rows);

}  // namespace faultline
