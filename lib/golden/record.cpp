// SPDX-License-Identifier: MIT
#include "lib/golden/record.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <utility>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/inner_file.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/text.hpp"
#include "lib/golden/check.hpp"
#include "lib/golden/tolerance.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

std::vector<ReplayLog> named_logs(const std::vector<std::string>& paths) {
  std::vector<ReplayLog> logs;
  std::set<std::string> names;
  for (const std::string& path : paths) {
    const std::string name = fs::path(path).filename().string();
    if (valid_utf8(name) != name || !is_plain_name(name) || name == kIdentification || name == kModelItem)
      throw Error(ErrorCode::usage, path, "cannot be named in golden.toml; rename the log");
    if (!names.insert(name).second)
      throw Error(ErrorCode::usage, path,
                  "has the same name as another log; names of golden logs must differ, rename one");
    logs.push_back({name, path, false});
  }
  return logs;
}

/// Path below the folder when the log lies there already, else empty.
std::string path_below(const std::string& folder, const std::string& path) {
  const fs::path relative = fs::weakly_canonical(path).lexically_relative(fs::weakly_canonical(folder));
  return relative.empty() || *relative.begin() == ".." ? "" : relative.generic_string();
}

GoldenFile taken_log(const std::string& folder, const ReplayLog& log) {
  const std::string below = path_below(folder, log.path);
  const std::string bytes = read_file(log.path);
  if (!below.empty()) return {below, sha256_hex(bytes)};
  write_inner_file(folder, "logs/" + log.name, bytes);
  return {"logs/" + log.name, sha256_hex(bytes)};
}

/// Sets set.identification; why not, when there is nothing to identify from.
std::string identify_from_healthy(const std::vector<ReplayLog>& logs, const GoldenRun& run,
                                  const Model& model, const LogOpener& open, const RecordOptions& options,
                                  GoldenSet& set) {
  if (!options.identify) return "not requested";
  std::vector<ReplayLog> healthy;
  GoldenIdentification identified;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (run.logs[i].observation.verdict != to_string(Verdict::healthy)) continue;
    healthy.push_back(logs[i]);
    identified.logs.push_back(logs[i].name);
  }
  if (healthy.empty()) return "no log was found healthy";
  identified.expected = observe_identification(healthy, model, open, options.threads);
  if (identified.expected.status == kUnusable) return identified.expected.reason;
  identified.tolerances = default_tolerances(identified.expected);
  set.identification = std::move(identified);
  return "";
}

void refuse_unusable(const GoldenRun& run, const std::string& name) {
  for (const GoldenRun::Log& log : run.logs)
    if (log.name == name && log.observation.verdict == kUnusable)
      throw Error(ErrorCode::input, name, "cannot be accepted: " + log.observation.reason);
  if (name == kIdentification && run.identification && run.identification->status == kUnusable)
    throw Error(ErrorCode::input, name, "cannot be accepted: " + run.identification->reason);
}

}  // namespace

Recorded record_golden(const std::string& folder, const std::vector<std::string>& paths,
                       const std::string& model, const std::string& cases, const LogOpener& open,
                       const RecordOptions& options, const Progress& progress) {
  if (fs::exists(golden_file(folder)))
    throw Error(
        ErrorCode::usage, folder,
        "is already a golden folder; change it with faultline golden accept, or record into another folder");
  const std::vector<ReplayLog> logs = named_logs(paths);
  const ModelAndCases subject = load_model_and_cases(model, cases);
  const GoldenRun run = replay(logs, subject, open, {options.trace_points, options.threads}, progress);
  for (const GoldenRun::Log& log : run.logs)
    if (log.observation.verdict == kUnusable)
      throw Error(ErrorCode::input, log.name, "cannot be a golden log: " + log.observation.reason);
  Recorded recorded;
  GoldenSet& set = recorded.set;
  set.program_version = run.program_version;
  set.trace_points = options.trace_points;
  set.tolerances = default_tolerances(subject.model);
  recorded.no_identification = identify_from_healthy(logs, run, subject.model, open, options, set);
  set = adopt_model(folder, model, subject, std::move(set));
  set.model_values = run.model_values;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    GoldenLog log;
    log.log = taken_log(folder, logs[i]);
    log.expected = run.logs[i].observation;
    set.logs.push_back(std::move(log));
  }
  save_golden(folder, set);
  return recorded;
}

void accept_golden(const std::string& folder, GoldenSet set, const GoldenRun& run,
                   const std::vector<std::string>& names, const NewModel& new_model,
                   const Tolerances& defaults) {
  for (const std::string& name : names) refuse_unusable(run, name);
  const std::vector<std::string> before = set.files();
  if (new_model.subject) {
    set = adopt_model(folder, new_model.model, *new_model.subject, std::move(set));
    set = with_actual(std::move(set), run, kModelItem);
  }
  for (const auto& [channel, tolerance] : defaults.by_channel)
    set.tolerances.by_channel.try_emplace(channel, tolerance);
  for (const std::string& name : names) {
    for (GoldenLog& log : set.logs)
      if (log.name() == name) log.log.sha256 = sha256_of_file((fs::path(folder) / log.log.path).string());
    set = with_actual(std::move(set), run, name);
  }
  save_golden(folder, set, before);
}

}  // namespace faultline
