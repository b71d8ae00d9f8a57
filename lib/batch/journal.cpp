// SPDX-License-Identifier: MIT
#include "lib/batch/journal.hpp"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "lib/core/error.hpp"
#include "lib/core/files/inner_file.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/json/json_fields.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kChecksum = 16;  // hexadecimal digits

std::string checksum(const std::string& text) { return sha256_hex(text).substr(0, kChecksum); }

/// Results are read and written under their names.
void refuse_names(const JournalEntry& entry, const std::string& journal) {
  const BatchRow& row = entry.row;
  const bool has_files = !entry.json_sha.empty() || !entry.html_sha.empty();
  const std::string* wrong = nullptr;
  if (!is_plain_log_name(row.log)) wrong = &row.log;
  if (row.result.empty() ? has_files : !is_plain_name(row.result)) wrong = &row.result;
  if (wrong)
    throw Error(ErrorCode::input, journal,
                "names the file \"" + *wrong +
                    "\", which is not the name of a file in this folder, so no batch wrote this journal. Do "
                    "not use these results; run the batch again into a new folder");
}

}  // namespace

void fields(auto& v, MaybeConst<JournalEntry> auto& entry) {
  v("key", entry.key);
  v("position", entry.position);
  v("json_sha", entry.json_sha);
  v("html_sha", entry.html_sha);
  v.as("row", entry.row, to_json_line, row_from_json);
}

namespace {

std::optional<JournalEntry> entry_from(const std::string& line) {
  if (line.size() < kChecksum + 2) return {};
  const std::string text = line.substr(kChecksum + 1);
  if (line.substr(0, kChecksum) != checksum(text)) return {};
  try {
    return fields_from_json<JournalEntry>(Json::parse(text), "");
  } catch (const std::exception&) {
    return {};  // not of this program: the log is done again
  }
}

}  // namespace

std::string to_journal_line(const JournalEntry& entry) {
  const std::string text = fields_to_json<Json>(entry).dump();
  return checksum(text) + " " + text + "\n";
}

std::vector<JournalEntry> read_journal_in_order(const std::string& path) {
  std::vector<JournalEntry> entries;
  if (!std::filesystem::exists(path)) return entries;
  std::ifstream lines(path, std::ios::binary);
  if (!lines) throw Error(ErrorCode::input, path, "cannot be opened; check its permissions");
  for (std::string line; std::getline(lines, line);)
    if (auto entry = entry_from(line)) {
      refuse_names(*entry, path);
      entries.push_back(std::move(*entry));
    }
  return entries;
}

std::map<std::string, JournalEntry> read_journal(const std::string& path) {
  std::map<std::string, JournalEntry> entries;
  for (JournalEntry& entry : read_journal_in_order(path))
    if (!entry.key.empty()) entries[entry.key] = std::move(entry);
  return entries;
}

}  // namespace faultline
