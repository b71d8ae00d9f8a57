// SPDX-License-Identifier: MIT
#include "lib/batch/batch_index.hpp"

#include "lib/batch/page/index_page.hpp"
#include "lib/core/atomic_file.hpp"

namespace faultline {
namespace {

std::set<std::string> result_names(const std::vector<JournalEntry>& entries) {
  std::set<std::string> names;
  for (const JournalEntry& entry : entries) {
    if (!entry.json_sha.empty()) names.insert(entry.row.result + ".json");
    if (!entry.html_sha.empty()) names.insert(entry.row.result + ".html");
  }
  return names;
}

}  // namespace

BatchIndex::BatchIndex(const BatchFolder& folder, int results)
    : folder_(folder),
      ndjson_(folder.file("index.ndjson")),
      csv_(folder.file("index.csv")),
      entries_(static_cast<std::size_t>(results)),
      there_(static_cast<std::size_t>(results)) {
  csv_.append(batch_csv_header());
}

void BatchIndex::put(int place, JournalEntry entry) {
  entries_[static_cast<std::size_t>(place)] = std::move(entry);
  there_[static_cast<std::size_t>(place)] = true;
  for (; next_ < there_.size() && there_[next_]; ++next_) {
    ndjson_.append(to_json_line(entries_[next_].row));
    csv_.append(to_csv_line(entries_[next_].row));
  }
}

BatchSummary BatchIndex::finish(const BatchFacts& facts) {
  ndjson_.finish();
  csv_.finish();
  std::vector<BatchRow> rows;
  std::string journal = "\n";
  bool pages = false;
  for (const JournalEntry& entry : entries_) {
    rows.push_back(entry.row);
    journal += to_journal_line(entry);
    pages = pages || !entry.html_sha.empty();
  }
  const BatchSummary summary = summary_of(rows, facts);
  write_file(folder_.file("summary.json"), to_json(summary));
  write_file(folder_.file("index.html"), render_index_page(rows, summary, pages));
  write_file(folder_.journal(), journal);
  folder_.clean(result_names(entries_));
  write_file(folder_.finished(), facts_to_json(facts));
  return summary;
}

}  // namespace faultline
