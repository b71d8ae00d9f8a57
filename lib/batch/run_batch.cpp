// SPDX-License-Identifier: MIT
#include "lib/batch/run_batch.hpp"

#include <atomic>
#include <filesystem>
#include <mutex>
#include <new>
#include <set>

#include "lib/batch/batch_index.hpp"
#include "lib/batch/earlier_results.hpp"
#include "lib/batch/log_result.hpp"
#include "lib/core/files/other_names.hpp"
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
      : setup_(setup), before_(setup.folder), journal_(setup.folder.journal()) {}

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
    return {index.finish(facts), progress_.diagnosed};
  }

 private:
  JournalEntry entry_of(const BatchLog& log, int position) {
    const FileStamp before = stamp_of(log.path);
    const auto unusable = [&](const Error& error) {
      const auto which = static_cast<std::size_t>(log.model);
      return fresh(
          at(position, unusable_result(log, before, error, setup_.facts[which], setup_.settings[which])));
    };
    try {
      refuse_special_file(log.path);
      const std::string& settings = setup_.settings[static_cast<std::size_t>(log.model)];
      if (const JournalEntry* done = before_.find(log, settings)) return at(position, *done);
      return fresh(at(position, write_log_result(log, setup_)));
    } catch (const std::bad_alloc&) {
      throw;  // of this machine now, not of the log
    } catch (const Error& error) {
      if (error.code() == ErrorCode::output) throw;
      return unusable(error);
    } catch (const std::exception& error) {
      return unusable(
          Error(ErrorCode::internal, log.path, std::string("defect of faultline: ") + error.what()));
    }
  }

  static JournalEntry at(int position, JournalEntry entry) {
    entry.position = position;
    return entry;
  }

  JournalEntry fresh(JournalEntry entry) {
    const std::lock_guard lock(mutex_);
    ++progress_.diagnosed;
    if (!entry.key.empty()) journal_.add(entry);
    return entry;
  }

  const BatchSetup& setup_;
  EarlierResults before_;
  JournalWriter journal_;
  std::mutex mutex_;
  BatchProgress progress_;
};

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
  facts.logs = static_cast<int>(logs.size());
  facts.shard = options.shard;
  facts.shards = options.shards;
  const BatchFolder out(folder, options.wait);
  refuse_other_names(out.journal());
  out.mark_unfinished();
  std::vector<std::string> settings;
  for (const ModelFacts& model : all) settings.push_back(settings_of(facts, model));
  const BatchSetup setup{open, models, out, options, all, settings};
  return Batch(setup).run(logs, facts);
}

}  // namespace faultline
