// SPDX-License-Identifier: MIT
#include "apps/service/job_run.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "apps/commands.hpp"
#include "apps/service/child.hpp"
#include "apps/service/report_facts.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

using Words = std::vector<std::string>;

std::string logs_path(const ServiceFolder& folder, std::int64_t id) { return folder.job_path(id) + "/logs"; }

/// Path of the log of an earlier job, from the folder of all jobs.
std::string log_among_jobs(const ServiceFolder& folder, std::int64_t id) {
  const Job job = read_job(folder.job_path(id), id);
  const std::string own = std::filesystem::path(folder.job_path(id)).filename().string();
  return own + "/logs/" + job.request.logs.at(0);
}

/// The log of a diagnosis with the other files of its run, as the command takes them.
Words log_words(const JobRequest& request) {
  Words words{request.logs.at(0)};
  if (request.files == RunFiles::single) return words;
  for (std::size_t k = 1; k < request.logs.size(); ++k) {
    words.push_back(request.files == RunFiles::columns ? "--join" : "--then");
    words.push_back(request.logs[k]);
  }
  return words;
}

/// The words that diagnose the log of a request with `options`.
Words diagnose_words(const ServiceFolder& folder, const JobRequest& logs, const Words& options) {
  Words words{"diagnose", "--model", folder.model_path(logs.model)};
  for (const Words& more : {log_words(logs), options}) words.insert(words.end(), more.begin(), more.end());
  return words;
}

Words learn_words(const ServiceFolder& folder, const Job& job) {
  const std::string own = folder.job_path(job.id) + "/";
  const std::int64_t of = job.request.of.at(0);
  Words words{"learn", "--robot", own + kSuggestedRobot, "-o", own + kLearnedModel};
  const Job healthy = read_job(folder.job_path(of), of);
  words.insert(words.end(), healthy.request.logs.begin(), healthy.request.logs.end());
  return words;
}

/// Words of the command, and the folder in which it runs: that of the logs, so that reports show the names
/// that the user gave them.
ChildCommand command_of(const ServiceFolder& folder, const Job& job) {
  const JobRequest& request = job.request;
  const std::string own = folder.job_path(job.id) + "/";
  ChildCommand command;
  command.folder = logs_path(folder, job.id);
  switch (request.kind) {
    case JobKind::diagnose:
      command.words =
          diagnose_words(folder, request, {"--json", own + kReportJson, "--html", own + kReportPage});
      break;
    case JobKind::record: {
      const std::int64_t of = request.of.at(0);
      command.folder = logs_path(folder, of);
      command.words =
          diagnose_words(folder, read_job(folder.job_path(of), of).request, {"--mcap", own + kRecording});
      break;
    }
    case JobKind::suggest:
      command.words = {"inspect", request.logs.at(0), "--suggest", own + kSuggestedRobot};
      break;
    case JobKind::learn:
      command.folder = logs_path(folder, request.of.at(0));
      command.words = learn_words(folder, job);
      break;
    case JobKind::compare:
      command.folder = folder.jobs_path();
      command.words = {"compare",
                       log_among_jobs(folder, request.of.at(0)),
                       log_among_jobs(folder, request.of.at(1)),
                       "--model",
                       folder.model_path(request.model),
                       "--html",
                       own + kComparisonPage};
      break;
  }
  command.answer_path = own + kAnswer;
  return command;
}

bool succeeded(JobKind kind, int status) {
  if (status == kNothingFound) return true;
  return status == kFindings && kind != JobKind::learn;
}

/// The first line of an answer that is not empty.
std::string first_line(const std::string& text) {
  std::size_t begin = text.find_first_not_of(" \n");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find('\n', begin) - begin);
}

/// What a diagnosis found, such as "joint 1 is locked, from 8.440 s on, and 1 more fault".
std::string found_sentence(const ReportFacts& report) {
  if (report.faults.empty()) return report.verdict_reason;
  const ReportedFault& first = report.faults.front();
  std::string text =
      plain_words(first.label) + ", from " + time_text(first.onset_s, report.sample_period_s) + " on";
  if (report.faults.size() > 1)
    text += ", and " + counted(static_cast<long long>(report.faults.size()) - 1, "more fault");
  return text;
}

JobOutcome diagnosis_outcome(const std::string& folder) {
  const ReportFacts report = report_facts(read_file(folder + kReportJson));
  return {JobState::done, report.verdict, found_sentence(report)};
}

JobOutcome done(const ServiceFolder& folder, const Job& job) {
  const std::string own = folder.job_path(job.id) + "/";
  switch (job.request.kind) {
    case JobKind::diagnose:
      return diagnosis_outcome(own);
    case JobKind::record:
      return {JobState::done, "", "The recording is ready."};
    case JobKind::suggest:
      return {JobState::done, "", "A robot file is suggested from the logs."};
    case JobKind::learn:
      folder.publish_model(own + kLearnedModel, job.request.model);
      return {JobState::done, "", "The model is ready."};
    case JobKind::compare:
      return {JobState::done, "", first_line(read_file(own + kAnswer))};
  }
  return {};
}

/// The message of the command, without the name of the program before it.
std::string message_of(const std::string& messages) {
  constexpr std::string_view kName = "faultline: ";
  const std::string text = messages.starts_with(kName) ? messages.substr(kName.size()) : messages;
  return brief(text.substr(0, text.find_last_not_of('\n') + 1));
}

}  // namespace

std::string own_program() {
  const char* stated = std::getenv("FAULTLINE_PROGRAM");
  return stated && *stated ? stated : "/proc/self/exe";
}

JobOutcome run_job(const ServiceFolder& folder, const Job& job, const JobProcess& process,
                   const std::function<bool(const std::string& step, double share)>& goes_on) {
  ChildCommand command = command_of(folder, job);
  command.program = process.program;
  command.most_s = process.most_s;
  const ChildRun run =
      run_child(command, [&](const ChildNews& news) { return goes_on(news.step, news.share); });
  switch (run.end) {
    case ChildEnd::stopped:
      return {JobState::cancelled, "", "The job was cancelled."};
    case ChildEnd::timed_out:
      return {
          JobState::failed, "",
          fmt::format("The job took longer than the limit of {:.0f} s and was ended; use a shorter log, or "
                      "start the service with a larger --most-minutes.",
                      process.most_s)};
    case ChildEnd::crashed:
      return {JobState::failed, "",
              fmt::format("The program ended by signal {}; the machine may have too little free memory.",
                          run.status)};
    case ChildEnd::exited:
      break;
  }
  if (!succeeded(job.request.kind, run.status)) return {JobState::failed, "", message_of(run.messages)};
  return done(folder, job);
}

}  // namespace faultline
