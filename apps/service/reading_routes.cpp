// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/service/http.hpp"
#include "apps/service/service.hpp"
#include "apps/service/stated_cases.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

using httplib::Request;
using httplib::Response;

constexpr std::size_t kLatestJobs = 20;                         // on the first page
constexpr std::size_t kMostShownBytes = std::size_t{64} << 20;  // of a file that a page quotes
constexpr const char* kNotThere = "This page is not there; the job may have been deleted.";

/// A result in the folder of a job that a browser may fetch.
struct JobFile {
  const char* name;
  const char* type;
  bool is_report;  ///< a page with a policy of its own
};
constexpr std::array<JobFile, 5> kJobFiles{{{kReportPage, "text/html; charset=utf-8", true},
                                            {kComparisonPage, "text/html; charset=utf-8", true},
                                            {kReportJson, "application/json", false},
                                            {kRecording, "application/octet-stream", false},
                                            {kAnswer, "text/plain; charset=utf-8", false}}};

std::vector<Job> runs_of(const std::vector<Job>& jobs, const std::string& model) {
  std::vector<Job> runs;
  for (const Job& job : jobs)
    if (job.request.kind == JobKind::diagnose && job.request.model == model) runs.push_back(job);
  return runs;
}

void show_home(ServiceState& state, const Request& request, Response& response) {
  std::vector<Job> jobs = state.queue.all();
  std::vector<ServedRobot> robots;
  for (const std::string& model : state.folder.models()) robots.push_back({model, runs_of(jobs, model)});
  if (jobs.size() > kLatestJobs) jobs.resize(kLatestJobs);
  send_page(response, home_page(context_for(state, request, response), robots,
                                state.folder.models_without_cases(), jobs));
}

void show_robot(ServiceState& state, const Request& request, Response& response) {
  const std::string model = request.matches[1];
  if (!state.folder.has_model(model))
    return send_refusal(state, request, response, 404, "There is no robot of this name.");
  const std::vector<Job> runs = runs_of(state.queue.all(), model);
  const auto page = whole_number(request.get_param_value("page"));
  send_page(response, robot_page(context_for(state, request, response), {model, runs},
                                 state.condition.of(runs), static_cast<std::size_t>(page.value_or(1))));
}

std::string text_if_there(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored) ? read_file(path, kMostShownBytes) : "";
}

JobFiles files_of(const ServiceState& state, const Job& job) {
  const std::string folder = state.folder.job_path(job.id) + "/";
  JobFiles files;
  if (job.outcome.state == JobState::done) {
    files.report = text_if_there(folder + kReportJson);
    files.answer = text_if_there(folder + kAnswer);
    files.robot_file = text_if_there(folder + kSuggestedRobot);
    if (state.folder.has_model(job.request.model))
      files.stated = stated_cases(state.folder.model_path(job.request.model), folder);
  }
  for (const Job& other : state.queue.all()) {
    const bool is_earlier = other.id < job.id && !other.has_ended() && !other.running;
    if (is_earlier) ++files.before;
    if (other.request.kind == JobKind::record && other.request.of.at(0) == job.id)
      files.recordings.push_back(other);
  }
  return files;
}

std::optional<Job> job_of(const ServiceState& state, const Request& request) {
  return state.queue.find(std::stoll(request.matches[1]));
}

void show_job(ServiceState& state, const Request& request, Response& response) {
  const auto job = job_of(state, request);
  if (!job) return send_refusal(state, request, response, 404, kNotThere);
  const PageContext context = context_for(state, request, response);
  try {
    send_page(response, job_page(context, *job, files_of(state, *job)));
  } catch (const std::exception& error) {
    Job damaged = *job;
    damaged.running = false;
    damaged.outcome = {
        JobState::failed, "",
        "The files of this job cannot be read; delete it, and send its log again: " + brief(error.what())};
    send_page(response, job_page(context, damaged, {}));
  }
}

void show_state(ServiceState& state, const Request& request, Response& response) {
  const auto job = job_of(state, request);
  if (!job) return send_refusal(state, request, response, 404, kNotThere);
  std::size_t before = 0;
  if (!job->running && !job->has_ended()) before = files_of(state, *job).before;
  const nlohmann::json json{
      {"ended", job->has_ended()},
      {"share", job->share},
      {"sentence", job->has_ended() ? job->outcome.sentence : progress_sentence(*job, before)}};
  response.set_content(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace),
                       "application/json");
}

/// Sends a file piece by piece.
void send_file(const Request& request, Response& response, const std::string& path, const char* type) {
  const auto file = std::make_shared<std::ifstream>(path, std::ios::binary);
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error || !*file) throw Error(ErrorCode::input, "the file", "is not there any more");
  for (const auto& [first, last] : request.ranges)
    if (first >= static_cast<ssize_t>(size) || (first < 0 && last <= 0)) {
      response.status = 416;
      return;
    }
  response.set_content_provider(
      size, type, [file](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        std::array<char, std::size_t{1} << 16> bytes;
        file->seekg(static_cast<std::streamoff>(offset));
        file->read(bytes.data(), static_cast<std::streamsize>(std::min(length, bytes.size())));
        const auto count = static_cast<std::size_t>(file->gcount());
        return count > 0 && sink.write(bytes.data(), count);
      });
}

void offer_as(Response& response, const std::string& name) {
  std::string encoded;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    encoded += std::isalnum(byte) || c == '.' || c == '-' || c == '_' ? std::string(1, c)
                                                                      : fmt::format("%{:02X}", byte);
  }
  response.set_header("Content-Disposition", "attachment; filename*=UTF-8''" + encoded);
}

void send_job_file(ServiceState& state, const Request& request, Response& response) {
  const auto job = job_of(state, request);
  const std::string name = request.matches[2];
  const bool has_ended = job && job->outcome.state == JobState::done;
  if (has_ended && name == "log" && job->request.kind == JobKind::diagnose) {
    const std::string& log = job->request.logs.at(0);
    offer_as(response, log);
    return send_file(request, response, state.folder.job_path(job->id) + "/logs/" + log,
                     "application/octet-stream");
  }
  for (const JobFile& file : kJobFiles) {
    const std::string path = has_ended ? state.folder.job_path(job->id) + "/" + file.name : "";
    if (name != file.name || path.empty() || !std::filesystem::exists(path)) continue;
    if (file.is_report)
      response.set_header("Content-Security-Policy", report_policy());
    else
      offer_as(response, fmt::format("{}-{}", job->id, file.name));
    return send_file(request, response, path, file.type);
  }
  send_refusal(state, request, response, 404, kNotThere);
}

}  // namespace

void add_reading_routes(httplib::Server& server, ServiceState& state) {
  using Show = void (*)(ServiceState&, const Request&, Response&);
  const auto get = [&](const char* pattern, Show show) {
    server.Get(pattern, [&state, show](const Request& request, Response& response) {
      show(state, request, response);
    });
  };
  get("/", show_home);
  get("/learn", [](ServiceState& there, const Request& request, Response& response) {
    send_page(response, learn_page(context_for(there, request, response)));
  });
  get("/login",
      [](ServiceState&, const Request&, Response& response) { send_page(response, login_page("")); });
  get("/robots/([^/]+)", show_robot);
  get("/jobs/([0-9]{1,12})", show_job);
  get("/jobs/([0-9]{1,12})/state\\.json", show_state);
  get("/jobs/([0-9]{1,12})/([a-z.]+)", send_job_file);
}

}  // namespace faultline
