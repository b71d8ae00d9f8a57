// SPDX-License-Identifier: MIT
#include "lib/batch/batch_index.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "lib/batch/batch_exports.hpp"
#include "lib/batch/page/index_page.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/output_place.hpp"

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

GrowingFile::GrowingFile(std::string path) : path_(std::move(path)) {
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ >= 0 && has_other_names(file_)) begin_anew();
  if (file_ < 0) fail();
}

/// The file has the other name from now on, this one gets a new file.
void GrowingFile::begin_anew() {
  ::close(file_);
  file_ = -1;
  if (::unlink(path_.c_str()) == 0)
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

GrowingFile::~GrowingFile() { ::close(file_); }

bool GrowingFile::is_there_already(std::string_view text) const {
  std::string there(text.size(), '\0');
  const auto got = ::pread(file_, there.data(), there.size(), size_);
  return got == static_cast<ssize_t>(text.size()) && there == text;
}

void GrowingFile::append(std::string_view text) {
  if (anew_ || !is_there_already(text)) {
    if (!anew_ && ::ftruncate(file_, size_) != 0) fail();
    anew_ = true;
    const auto written = ::pwrite(file_, text.data(), text.size(), size_);
    if (written != static_cast<ssize_t>(text.size())) {
      if (written >= 0) errno = ENOSPC;
      const int why = errno;
      if (::ftruncate(file_, size_) == 0) errno = why;  // whole lines only
      fail();
    }
  }
  size_ += static_cast<long long>(text.size());
}

void GrowingFile::finish() {
  if (::ftruncate(file_, size_) != 0) fail();
}

void GrowingFile::fail() const {
  throw Error(ErrorCode::output, path_,
              std::string("cannot be written (") + std::strerror(errno) +
                  "); finished logs are kept: make room and run the same command again");
}

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
  const std::set<std::string> results = result_names(entries_);
  const bool pages = std::any_of(entries_.begin(), entries_.end(),
                                 [](const JournalEntry& entry) { return !entry.html_sha.empty(); });
  AtomicFile journal(folder_.journal());
  journal.write("\n");
  std::vector<BatchRow> rows;  // in the place of the entries: a batch may have a hundred thousand
  rows.reserve(entries_.size());
  for (JournalEntry& entry : entries_) {
    journal.write(to_journal_line(entry));
    rows.push_back(std::move(entry.row));
  }
  entries_.clear();
  const BatchSummary summary = summary_of(rows, facts);
  write_file(folder_.file("summary.json"), to_json(summary));
  write_file(folder_.file("index.html"), render_index_page(rows, summary, pages));
  write_file(folder_.file("faultline_mqc.json"), batch_multiqc(rows));
  journal.commit();
  folder_.clean(results);
  write_file(folder_.finished(), facts_to_json(facts));
  return summary;
}

}  // namespace faultline
