// SPDX-License-Identifier: MIT
#include "lib/batch/merge_batches.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>

#include "lib/batch/batch_index.hpp"
#include "lib/core/hash.hpp"

namespace faultline {
namespace {

/// What one folder adds, and where its files are.
struct Part {
  std::unique_ptr<BatchFolder> folder;
  BatchFacts facts;
};

Part open_part(const std::string& path) {
  if (!is_batch_folder(path))
    throw Error(ErrorCode::input, path, "is not a result folder of faultline batch");
  Part part{std::make_unique<BatchFolder>(path, false), {}};
  if (!std::filesystem::exists(part.folder->finished()))
    throw Error(ErrorCode::input, path,
                "is not finished; run its batch again, which continues where it stopped");
  part.facts = read_facts(part.folder->finished());
  return part;
}

void refuse_others(const BatchFacts& facts, const BatchFacts& first, const std::string& path) {
  if (settings_of(facts) != settings_of(first))
    throw Error(ErrorCode::input, path,
                "has another model, case base, version or options than the first folder");
  if (facts.logs != first.logs)
    throw Error(ErrorCode::input, path,
                fmt::format("is a part of a list of {} logs, the first folder of one of {}; if logs were "
                            "added meanwhile, run the shards again",
                            facts.logs, first.logs));
}

void copy(const std::string& name, const BatchFolder& from, const BatchFolder& to,
          const std::string& sha256) {
  if (sha256.empty()) return;
  const std::string bytes = from.read(name);
  if (sha256_hex(bytes) != sha256)
    throw Error(ErrorCode::input, from.file(name),
                "was changed after the batch wrote it; run its batch again");
  to.write(name, bytes);
}

void copy_results(const JournalEntry& entry, const BatchFolder& from, const BatchFolder& to) {
  const std::string stem = "logs/" + entry.row.result;
  copy(stem + ".json", from, to, entry.json_sha);
  copy(stem + ".html", from, to, entry.html_sha);
}

void refuse_position(int position, int logs, const std::string& journal) {
  if (position < 0 || position >= logs)
    throw Error(ErrorCode::input, journal,
                fmt::format("has a log at position {} of a list of {}; it is damaged, run its batch again",
                            position, logs));
}

void refuse_missing(const std::map<int, JournalEntry>& entries, int logs) {
  for (int position = 0; position < logs; ++position)
    if (!entries.count(position))
      throw Error(ErrorCode::input, "batch merge",
                  fmt::format("{} of {} logs are missing, the first at position {}; give the folders of all "
                              "shards",
                              logs - static_cast<int>(entries.size()), logs, position));
}

}  // namespace

BatchSummary merge_batches(const std::vector<std::string>& folders, const std::string& into) {
  std::vector<Part> parts;
  for (const std::string& folder : folders) {
    parts.push_back(open_part(folder));
    refuse_others(parts.back().facts, parts.front().facts, folder);
  }
  std::map<int, JournalEntry> entries;
  std::map<int, const BatchFolder*> places;
  for (const Part& part : parts)
    for (JournalEntry& entry : read_journal_in_order(part.folder->journal())) {
      refuse_position(entry.position, parts.front().facts.logs, part.folder->journal());
      places[entry.position] = part.folder.get();
      entries[entry.position] = std::move(entry);
    }
  BatchFacts facts = parts.front().facts;
  refuse_missing(entries, facts.logs);
  facts.shard = 0;
  facts.shards = 1;
  const BatchFolder out(into, false);
  out.mark_unfinished();
  BatchIndex index(out, facts.logs);
  for (auto& [position, entry] : entries) {
    copy_results(entry, *places[position], out);
    index.put(position, std::move(entry));
  }
  return index.finish(facts);
}

}  // namespace faultline
