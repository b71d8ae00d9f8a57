// SPDX-License-Identifier: MIT
#include "apps/service/condition_view.hpp"

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/history/robot_history.hpp"

namespace faultline {

const HistoryRecord& ConditionView::record(std::int64_t id) {
  const auto known = records_.find(id);
  if (known != records_.end()) return known->second;
  const std::string path = folder_.job_path(id) + "/" + kReportJson;
  return records_[id] = history_record(read_file(path), path);
}

void ConditionView::note(const Job& job) {
  if (job.request.kind != JobKind::diagnose || job.outcome.state != JobState::done) return;
  const std::lock_guard lock(mutex_);
  try {
    record(job.id);
  } catch (const Error&) {
    return;  // deleted in the meantime
  }
}

std::string ConditionView::of(const std::vector<Job>& runs) {
  const std::lock_guard lock(mutex_);
  std::map<std::string, std::size_t> by_log;  // a log that was diagnosed twice counts once, as the latest
  std::vector<HistoryRecord> records;
  for (auto run = runs.rbegin(); run != runs.rend(); ++run) {
    if (run->outcome.state != JobState::done) continue;
    try {
      HistoryRecord one = record(run->id);
      one.robot = run->request.model;
      const auto [at, is_new] = by_log.emplace(one.log_sha256 + one.model_sha256, records.size());
      if (is_new)
        records.push_back(one);
      else
        records[at->second] = one;
    } catch (const Error&) {
      continue;  // deleted in the meantime
    }
  }
  if (records.size() < 2) return "";
  const std::vector<RobotHistory> robots = robot_histories(records, {});
  return robots.empty() ? "" : wear_table(robots[0].wear);
}

}  // namespace faultline
