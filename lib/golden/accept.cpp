// SPDX-License-Identifier: MIT
#include "lib/golden/accept.hpp"

#include <filesystem>
#include <utility>

#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/golden/check.hpp"

namespace faultline {
namespace {

void refuse_unusable(const GoldenRun& run, const std::string& name) {
  for (const GoldenRun::Log& log : run.logs)
    if (log.name == name && log.observation.verdict == kUnusable)
      throw Error(ErrorCode::input, name, "cannot be accepted: " + log.observation.reason);
  if (name == kIdentification && run.identification && run.identification->status == kUnusable)
    throw Error(ErrorCode::input, name, "cannot be accepted: " + run.identification->reason);
}

/// The set with the hash that the log of that name has now.
GoldenSet rehashed(const std::string& folder, GoldenSet set, const std::string& name) {
  for (GoldenLog& log : set.logs)
    if (log.name() == name)
      log.log.sha256 = sha256_of_file((std::filesystem::path(folder) / log.log.path).string());
  return set;
}

std::vector<std::string> files_of(const GoldenSet& set) {
  std::vector<std::string> files = {set.model.path, set.cases.path};
  for (const GoldenLog& log : set.logs) files.push_back(log.trace.path);
  return files;
}

}  // namespace

void accept_golden(const std::string& folder, GoldenSet set, const GoldenRun& run,
                   const std::vector<std::string>& names, const NewModel& new_model,
                   const Tolerances& defaults) {
  for (const std::string& name : names) refuse_unusable(run, name);
  const std::vector<std::string> before = files_of(set);
  if (new_model.subject) {
    set = adopt_model(folder, new_model.model, *new_model.subject, std::move(set));
    set = with_actual(std::move(set), run, kModelItem);
  }
  for (const auto& [channel, tolerance] : defaults.by_channel)
    set.tolerances.by_channel.try_emplace(channel, tolerance);
  for (const std::string& name : names) {
    set = rehashed(folder, std::move(set), name);
    set = with_actual(std::move(set), run, name);
  }
  save_golden(folder, set, before);
}

}  // namespace faultline
