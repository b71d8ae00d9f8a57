// SPDX-License-Identifier: MIT
#include "lib/batch/run_batch.hpp"

#include <fmt/format.h>

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <set>

#include "lib/batch/batch_index.hpp"
#include "lib/batch/log_result.hpp"
#include "lib/core/files/output_place.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/parallel.hpp"
#include "lib/core/version.hpp"

namespace faultline {
namespace {

std::string options_text(const BatchOptions& options) {
  std::string text = "--classify evidence";
  if (options.diagnose.mode == ClassifyMode::samples) {
    text = "--classify samples --criterion ";
    text += to_string(options.diagnose.criterion);
    text += " --g " + std::to_string(options.diagnose.g);
  }
  if (options.html) text += " --html";
  return options.identify ? text + " --identify" : text;
}

void refuse_special_file(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw Error(ErrorCode::input, path, "is a folder that cannot be read; check its permissions");
  if (!std::filesystem::is_regular_file(path, error))
    throw Error(ErrorCode::input, path, "is not a regular file");
}

/// In the order in which the list uses them, so that the order of options changes no byte.
std::vector<ModelFacts> used(const std::vector<ModelFacts>& models, const std::vector<BatchLog>& logs) {
  std::vector<ModelFacts> found;
  std::set<std::string> seen;
  for (const BatchLog& log : logs) {
    const ModelFacts& model = models[static_cast<std::size_t>(log.model)];
    if (seen.insert(model.sha256 + model.cases_sha256).second) found.push_back(model);
  }
  return found;
}

/// The work on one list of logs.
class Batch {
 public:
  explicit Batch(const BatchSetup& setup)
      : setup_(setup),
        before_(setup.folder),
        journal_(setup.folder.journal()),
        known_(setup.folder.known_logs()) {}

  BatchResult run(const std::vector<BatchLog>& logs, const BatchFacts& facts) {
    std::vector<int> positions;
    for (int i = facts.shard; i < facts.logs; i += facts.shards) positions.push_back(i);
    const int count = static_cast<int>(positions.size());
    BatchIndex index(setup_.folder, count);
    progress_.logs = count;
    std::atomic<bool> stopped = false;
    parallel_for(count, setup_.options.threads, [&](int place) {
      if (stopped) return;
      try {
        JournalEntry entry = entry_of(logs[static_cast<std::size_t>(positions[place])], positions[place]);
        const std::lock_guard lock(mutex_);
        index.put(place, std::move(entry));
        ++progress_.done;
        if (setup_.options.progress) setup_.options.progress(progress_);
      } catch (...) {
        stopped = true;
        throw;
      }
    });
    known_.finish();
    return {index.finish(facts), progress_.diagnosed};
  }

 private:
  JournalEntry entry_of(const BatchLog& log, int position) {
    const auto which = static_cast<std::size_t>(log.model);
    const std::string& settings = setup_.settings[which];
    const std::vector<FileStamp> before = stamps_of(files_of(log));
    JournalEntry entry;
    const auto take_unusable = [&](const Error& error) {
      entry = unusable_result(log, before.front(), error, setup_.facts[which], settings);
    };
    try {
      refuse_special_file(log.path);
      if (const JournalEntry* done = before_.find(log, before, settings, known_)) {
        entry = *done;
        entry.position = position;
        return entry;
      }
      entry = write_log_result(log, setup_);
    } catch (const std::bad_alloc&) {
      throw;  // of this machine now, not of the log
    } catch (const Error& error) {
      if (error.code() == ErrorCode::output) throw;
      take_unusable(error);
    } catch (const std::exception& error) {
      take_unusable(
          Error(ErrorCode::internal, log.path, std::string("defect of faultline: ") + error.what()));
    }
    entry.position = position;
    const std::lock_guard lock(mutex_);
    ++progress_.diagnosed;
    if (!entry.key.empty()) journal_.add(to_journal_line(entry));
    note_result(log, before, entry, setup_.folder, known_);
    return entry;
  }

  const BatchSetup& setup_;
  EarlierResults before_;
  AppendedLines journal_;
  KnownLogs known_;
  std::mutex mutex_;
  BatchProgress progress_;
};

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
  to.write_unsynced(name, bytes);
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

BatchResult run_batch(const std::vector<BatchLog>& logs, const OpenLog& open,
                      const std::vector<ModelFiles>& models, const std::string& folder,
                      const BatchOptions& options) {
  std::vector<ModelFacts> all;
  for (const auto& [model, cases] : models)
    all.push_back({model.name, model.sha256, cases.sha256(), notes_of(model), model.grave_doubts});
  BatchFacts facts;
  facts.models = used(all, logs);
  facts.program_version = program_version();
  facts.options = options_text(options);
  facts.twins = options.twins;
  facts.logs = static_cast<int>(logs.size());
  facts.shard = options.shard;
  facts.shards = options.shards;
  const BatchFolder out(folder, options.wait);
  refuse_other_names(out.journal());
  refuse_other_names(out.known_logs());
  out.mark_unfinished();
  std::vector<std::string> settings;
  for (const ModelFacts& model : all) settings.push_back(settings_of(facts, model));
  const BatchSetup setup{open, models, out, options, all, settings};
  return Batch(setup).run(logs, facts);
}

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
  out.sync();
  return index.finish(facts);
}

}  // namespace faultline
