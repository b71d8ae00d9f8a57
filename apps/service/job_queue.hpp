// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <vector>

#include "apps/service/job_run.hpp"
#include "apps/service/service_folder.hpp"

namespace faultline {

struct QueueLimits {
  int workers = 0;                  ///< jobs at the same time; 0: one a core
  JobProcess process{};             ///< of each job
  std::size_t most_waiting = 1000;  ///< jobs
  /// Called by a worker when a job has ended, if it is set.
  std::function<void(const Job&)> ended{};
};

/// The jobs of a service. Each runs as a command of this program in a process of its own. A job that add()
/// returned survives the end of the service, however that comes: what had not ended runs again at the next
/// start, and writes the same files again.
///
/// Safe to call from several threads.
class JobQueue {
 public:
  /// Reads the jobs of the folder, which must outlive the queue, and starts the workers. A job whose files
  /// are damaged is a failed one, which can be removed.
  JobQueue(const ServiceFolder& folder, const QueueLimits& limits);
  /// Ends running jobs; they run again at the next start.
  ~JobQueue();

  /// Turns a complete upload into a job. Throws Error(usage) if too many jobs wait, or if a job that it needs
  /// is missing; Error(output) if it cannot be stored.
  Job add(const std::string& incoming, const JobRequest& request);

  std::optional<Job> find(std::int64_t id) const;
  /// All jobs, the latest first.
  std::vector<Job> all() const;
  /// A number that changes whenever a job ends or is removed.
  std::int64_t version() const;

  /// Ends a job that has not ended. Returns false if there is none.
  bool cancel(std::int64_t id);
  /// Removes a job that has ended, with its files. Returns false if there is none. Throws Error(usage) if
  /// another job still needs its logs.
  bool remove(std::int64_t id);

 private:
  void work();
  std::optional<Job> next_job();
  bool note_progress(std::int64_t id, const std::string& step, double share);
  void finish(std::int64_t id, const JobOutcome& outcome);
  void check_needed_jobs(const JobRequest& request) const;

  const ServiceFolder& folder_;
  QueueLimits limits_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::map<std::int64_t, Job> jobs_;
  std::set<std::int64_t> waiting_, cancelled_;  // cancelled_: running ones that are to end
  std::int64_t last_id_ = 0, version_ = 0;
  bool stopping_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace faultline
