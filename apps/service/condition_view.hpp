// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "apps/service/job.hpp"
#include "apps/service/service_folder.hpp"
#include "lib/history/history_record.hpp"

namespace faultline {

/// The condition of a robot over its runs, as a part of its page. Remembers what it read of each report, so
/// that a page does not read hundreds. Safe to call from several threads.
class ConditionView {
 public:
  explicit ConditionView(const ServiceFolder& folder) : folder_(folder) {}

  /// Reads the report of a job, if it is a diagnosis that succeeded.
  void note(const Job& job);
  /// HTML; empty if `runs` (diagnoses of one robot, the latest first) hold too little for it.
  std::string of(const std::vector<Job>& runs);

 private:
  const HistoryRecord& record(std::int64_t id);

  const ServiceFolder& folder_;
  std::mutex mutex_;
  std::map<std::int64_t, HistoryRecord> records_;
};

}  // namespace faultline
