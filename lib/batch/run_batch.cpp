// SPDX-License-Identifier: MIT
#include "lib/batch/run_batch.hpp"

#include <atomic>
#include <filesystem>
#include <mutex>
#include <new>

#include "lib/batch/batch_index.hpp"
#include "lib/batch/log_result.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/parallel.hpp"
#include "lib/core/version.hpp"

namespace faultline {
namespace {

std::string options_text(const BatchOptions& options) {
  std::string text = "--classify evidence";
  if (options.diagnose.mode == ClassifyMode::samples) {
    text = "--classify samples --criterion ";
    text += options.diagnose.criterion == CriterionKind::consecutive ? "consecutive" : "log_odds";
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
    throw Error(ErrorCode::input, path, "is no regular file");
}

/// The work on one list of logs into one folder.
class Batch {
 public:
  Batch(const OpenLog& open, const Model& model, const CaseBase& cases, const BatchFolder& folder,
        const BatchOptions& options, const BatchFacts& facts)
      : open_(open),
        model_(model),
        cases_(cases),
        folder_(folder),
        options_(options),
        settings_(settings_of(facts)),
        before_(read_journal(folder.journal())),
        journal_(folder.journal()) {}

  BatchResult run(const std::vector<BatchLog>& logs, const BatchFacts& facts) {
    std::vector<int> positions;
    for (int i = facts.shard; i < facts.logs; i += facts.shards) positions.push_back(i);
    const int count = static_cast<int>(positions.size());
    BatchIndex index(folder_, count);
    progress_.logs = count;
    std::atomic<bool> stopped = false;
    parallel_for(count, options_.threads, [&](int place) {
      if (stopped) return;
      try {
        JournalEntry entry = entry_of(logs[static_cast<std::size_t>(positions[place])], positions[place]);
        const std::lock_guard lock(mutex_);
        index.put(place, std::move(entry));
        ++progress_.done;
        if (options_.progress) options_.progress(progress_);
      } catch (...) {
        stopped = true;
        throw;
      }
    });
    return {index.finish(facts), progress_.diagnosed};
  }

 private:
  JournalEntry entry_of(const BatchLog& log, int position) {
    std::string sha256, key;
    try {
      refuse_special_file(log.path);
      sha256 = sha256_of_file(log.path);
      key = result_key(settings_, log, sha256);
      if (const JournalEntry* done = find_done(key)) return at(*done, position);
      return fresh(write_log_result(log, sha256, open_, model_, cases_, folder_, options_), key, position);
    } catch (const std::bad_alloc&) {
      throw;  // of this machine now, not of the log
    } catch (const Error& error) {
      if (error.code() == ErrorCode::output) throw;
      return fresh(unusable(log, sha256, error), may_recover(log, sha256) ? "" : key, position);
    } catch (const std::exception& error) {
      const Error defect(ErrorCode::internal, log.path, std::string("defect of faultline: ") + error.what());
      return fresh(unusable(log, sha256, defect), "", position);
    }
  }

  const JournalEntry* find_done(const std::string& key) const {
    const auto found = before_.find(key);
    return found != before_.end() && is_intact(found->second, folder_) ? &found->second : nullptr;
  }

  static JournalEntry at(JournalEntry entry, int position) {
    entry.position = position;
    return entry;
  }

  /// Whether the log is another one now than when its hash was taken.
  static bool may_recover(const BatchLog& log, const std::string& sha256) {
    try {
      return sha256.empty() || sha256_of_file(log.path) != sha256;
    } catch (const Error&) {
      return true;
    }
  }

  static JournalEntry unusable(const BatchLog& log, const std::string& sha256, const Error& error) {
    JournalEntry entry;
    entry.row = unusable_row(log.name, log.path, error);
    entry.row.sha256 = sha256;
    return entry;
  }

  JournalEntry fresh(JournalEntry entry, const std::string& key, int position) {
    entry.key = key;
    entry.position = position;
    const std::lock_guard lock(mutex_);
    ++progress_.diagnosed;
    if (!key.empty()) journal_.add(entry);
    return entry;
  }

  const OpenLog& open_;
  const Model& model_;
  const CaseBase& cases_;
  const BatchFolder& folder_;
  const BatchOptions& options_;
  std::string settings_;
  std::map<std::string, JournalEntry> before_;
  JournalWriter journal_;
  std::mutex mutex_;
  BatchProgress progress_;
};

}  // namespace

BatchResult run_batch(const std::vector<BatchLog>& logs, const OpenLog& open, const Model& model,
                      const CaseBase& cases, const std::string& folder, const BatchOptions& options) {
  BatchFacts facts;
  facts.model = {model.name, model.sha256, cases.sha256()};
  facts.program_version = program_version();
  facts.options = options_text(options);
  facts.logs = static_cast<int>(logs.size());
  facts.shard = options.shard;
  facts.shards = options.shards;
  const BatchFolder out(folder, options.wait);
  out.mark_unfinished();
  return Batch(open, model, cases, out, options, facts).run(logs, facts);
}

}  // namespace faultline
