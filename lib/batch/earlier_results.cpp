// SPDX-License-Identifier: MIT
#include "lib/batch/earlier_results.hpp"

#include "lib/batch/log_result.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/utf8.hpp"

namespace faultline {
namespace {

bool is_file_with(const BatchFolder& folder, const std::string& name, const std::string& sha256) {
  return sha256.empty() || (folder.has(name) && sha256_of_file(folder.file(name)) == sha256);
}

bool is_intact(const JournalEntry& entry, const BatchFolder& folder) {
  const std::string stem = "logs/" + entry.row.result;
  return is_file_with(folder, stem + ".json", entry.json_sha) &&
         is_file_with(folder, stem + ".html", entry.html_sha);
}

}  // namespace

EarlierResults::EarlierResults(const BatchFolder& folder)
    : folder_(folder), entries_(read_journal(folder.journal())) {
  for (const auto& [key, entry] : entries_) logs_.insert(entry.row.log);
}

const JournalEntry* EarlierResults::find(const BatchLog& log, const std::string& settings) const {
  if (!logs_.count(valid_utf8(log.name))) return nullptr;
  const auto found = entries_.find(result_key(settings, log, sha256_of_file(log.path)));
  return found != entries_.end() && is_intact(found->second, folder_) ? &found->second : nullptr;
}

}  // namespace faultline
