// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace faultline {

/// What a job does. Each is a command of this program over uploaded files.
enum class JobKind {
  diagnose,  ///< one log with a model: a report
  record,    ///< the log of an earlier diagnosis with its curves as MCAP
  suggest,   ///< healthy logs of a new robot: a robot file to look at
  learn,     ///< the logs of an earlier suggestion: a model
  compare,   ///< the logs of two earlier diagnoses: where the runs differ
};
const char* to_string(JobKind kind);

/// How the logs of a diagnosis belong together.
enum class RunFiles {
  single,   ///< the first file is the run; others are data files that it names
  columns,  ///< each file has other columns of one run (--join)
  rows,     ///< each file goes on where the one before ends (--then)
};
const char* to_string(RunFiles files);

/// What a user requested.
struct JobRequest {
  JobKind kind = JobKind::diagnose;
  std::string model{};              ///< its name; of learn, the one to make; of suggest, empty
  std::vector<std::string> logs{};  ///< names of the uploaded files, in the subfolder `logs` of the job
  std::vector<std::int64_t> of{};   ///< the earlier jobs whose logs are used
  std::int64_t received_s = 0;      ///< when, seconds since 1970
  RunFiles files = RunFiles::single;
};

enum class JobState { waiting, running, done, failed, cancelled };
const char* to_string(JobState state);

/// How a job ended.
struct JobOutcome {
  JobState state = JobState::waiting;  ///< waiting: it has not ended
  std::string verdict{};               ///< of a diagnosis, as in its JSON
  std::string sentence{};              ///< the result, or why there is none
};

struct Job {
  std::int64_t id = 0;
  JobRequest request{};
  JobOutcome outcome{};
  bool running = false;
  std::string step{};   ///< of a running job; may be empty
  double share = -1.0;  ///< done of a running job, 0 to 1; below 0: unknown

  JobState state() const { return running ? JobState::running : outcome.state; }
  bool has_ended() const { return !running && outcome.state != JobState::waiting; }
};

/// Name of the log, or of the logs, in words for a list.
std::string title_of(const Job& job);

// The files of a job in its folder. A job without outcome is run again when the service starts.
void write_request(const std::string& folder, const JobRequest& request);
void write_outcome(const std::string& folder, const JobOutcome& outcome);
/// Throws Error(input) for a folder without a readable request.
Job read_job(const std::string& folder, std::int64_t id);

// Names of the results in the folder of a job.
inline constexpr const char* kReportJson = "report.json";
inline constexpr const char* kReportPage = "report.html";
inline constexpr const char* kRecording = "recording.mcap";
inline constexpr const char* kSuggestedRobot = "robot.toml";
inline constexpr const char* kComparisonPage = "comparison.html";
inline constexpr const char* kLearnedModel = "learned.model";
inline constexpr const char* kAnswer = "answer.txt";  ///< standard output of the command

}  // namespace faultline
