// SPDX-License-Identifier: MIT
#include "apps/service/job_queue.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {

JobQueue::JobQueue(const ServiceFolder& folder, const QueueLimits& limits)
    : folder_(folder), limits_(limits) {
  last_id_ = folder_.last_used_id();
  for (const std::int64_t id : folder_.job_ids()) {
    Job& job = jobs_[id];
    try {
      job = read_job(folder_.job_path(id), id);
    } catch (const Error& error) {
      job.id = id;
      job.outcome = {JobState::failed, "", brief(error.what())};
    }
    if (!job.has_ended()) waiting_.insert(id);
  }
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  for (int i = 0; i < (limits_.workers > 0 ? limits_.workers : cores); ++i)
    workers_.emplace_back([this] { work(); });
}

JobQueue::~JobQueue() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  arrived_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void JobQueue::check_needed_jobs(const JobRequest& request) const {
  for (const std::int64_t id : request.of) {
    const auto found = jobs_.find(id);
    if (found == jobs_.end())
      throw Error(ErrorCode::usage, fmt::format("job {}", id), "is not there; it may have been deleted");
    const JobKind needed = request.kind == JobKind::learn ? JobKind::suggest : JobKind::diagnose;
    if (found->second.request.kind != needed)
      throw Error(ErrorCode::usage, fmt::format("job {}", id), "has no log that this could use");
  }
}

Job JobQueue::add(const std::string& incoming, const JobRequest& request) {
  Job job;
  job.request = request;
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= limits_.most_waiting)
      throw Error(ErrorCode::usage, "the queue",
                  fmt::format("is full ({} wait); try again when some of them have ended",
                              counted(static_cast<long long>(waiting_.size()), "job")));
    check_needed_jobs(request);
    job.id = ++last_id_;
  }
  write_request(incoming, request);
  folder_.take_in(incoming, job.id);
  const std::lock_guard lock(mutex_);
  jobs_[job.id] = job;
  waiting_.insert(job.id);
  arrived_.notify_one();
  return job;
}

std::optional<Job> JobQueue::find(std::int64_t id) const {
  const std::lock_guard lock(mutex_);
  const auto found = jobs_.find(id);
  return found == jobs_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<Job> JobQueue::all() const {
  const std::lock_guard lock(mutex_);
  std::vector<Job> jobs;
  for (auto at = jobs_.rbegin(); at != jobs_.rend(); ++at) jobs.push_back(at->second);
  return jobs;
}

std::int64_t JobQueue::version() const {
  const std::lock_guard lock(mutex_);
  return version_;
}

bool JobQueue::cancel(std::int64_t id) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = jobs_.find(id);
    if (found == jobs_.end() || found->second.has_ended()) return false;
    if (found->second.running) {
      cancelled_.insert(id);
      return true;
    }
    waiting_.erase(id);
  }
  finish(id, {JobState::cancelled, "", "The job was cancelled before it began."});
  return true;
}

bool JobQueue::remove(std::int64_t id) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = jobs_.find(id);
    if (found == jobs_.end() || !found->second.has_ended()) return false;
    for (const auto& [other_id, other] : jobs_) {
      const std::vector<std::int64_t>& of = other.request.of;
      if (!other.has_ended() && std::find(of.begin(), of.end(), id) != of.end())
        throw Error(ErrorCode::usage, fmt::format("job {}", id),
                    fmt::format("job {} still needs its logs; wait for it, or cancel it first", other_id));
    }
    jobs_.erase(found);
    ++version_;
  }
  folder_.remove_job(id);
  return true;
}

std::optional<Job> JobQueue::next_job() {
  std::unique_lock lock(mutex_);
  arrived_.wait(lock, [&] { return stopping_ || !waiting_.empty(); });
  if (stopping_) return std::nullopt;
  Job& job = jobs_[*waiting_.begin()];
  waiting_.erase(waiting_.begin());
  job.running = true;
  return job;
}

bool JobQueue::note_progress(std::int64_t id, const std::string& step, double share) {
  const std::lock_guard lock(mutex_);
  Job& job = jobs_[id];
  job.step = step;
  job.share = share;
  return !stopping_ && cancelled_.count(id) == 0;
}

void JobQueue::finish(std::int64_t id, const JobOutcome& outcome) {
  write_outcome(folder_.job_path(id), outcome);
  const std::lock_guard lock(mutex_);
  Job& job = jobs_[id];
  job.running = false;
  job.outcome = outcome;
  ++version_;
}

void JobQueue::work() {
  while (const auto job = next_job()) {
    JobOutcome outcome;
    try {
      outcome = run_job(folder_, *job, limits_.process, [&](const std::string& step, double share) {
        return note_progress(job->id, step, share);
      });
    } catch (const std::exception& error) {
      outcome = {JobState::failed, "", brief(error.what())};
    }
    const bool ends_with_the_service = [&] {
      const std::lock_guard lock(mutex_);
      const bool is_cancelled = cancelled_.erase(job->id) > 0;
      return outcome.state == JobState::cancelled && !is_cancelled;
    }();
    if (ends_with_the_service) return;
    try {
      finish(job->id, outcome);
      if (const auto ended = find(job->id); ended && limits_.ended) limits_.ended(*ended);
    } catch (
        const Error& error) {  // a full disk: the result is shown, and the job runs again at the next start
      const std::lock_guard lock(mutex_);
      Job& there = jobs_[job->id];
      there.running = false;
      there.outcome = {JobState::failed, "", brief(error.what())};
      ++version_;
    }
  }
}

}  // namespace faultline
