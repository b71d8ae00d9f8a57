// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "apps/service/http.hpp"
#include "apps/service/service.hpp"
#include "apps/service/stated_cases.hpp"
#include "formats/open_log.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/enum_named.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

using httplib::ContentReader;
using httplib::Request;
using httplib::Response;

constexpr const char* kModelEnding = ".model";
constexpr std::size_t kLongestStatement = 2000;  // bytes of what was done, and of a name

/// Sends the browser to another page: with 303, so that loading again does not send the form again.
void send_to(const Request& request, Response& response, const std::string& address) {
  if (request.get_header_value("Accept") == "application/json")
    response.set_content(nlohmann::json{{"location", address}}.dump(), "application/json");
  else
    response.set_redirect(address, 303);
}

/// Number of a job or a fault in a field; 0, which none has, for other text.
std::int64_t number_of(const SentForm& form, const char* field) {
  return whole_number(form.field(field)).value_or(0);
}

/// The uploaded files by run: the log first, then the data files that it names.
std::vector<std::vector<std::string>> files_by_run(const SentForm& form) {
  std::map<std::string, std::vector<std::string>> beside;
  std::set<std::string> data;
  for (const std::string& log : form.files())
    for (const std::string& path : files_beside(form.incoming().log(log))) {
      const std::string name = std::filesystem::path(path).filename().string();
      if (data.insert(name).second) beside[log].push_back(name);
    }
  std::vector<std::vector<std::string>> runs;
  for (const std::string& log : form.files()) {
    if (data.contains(log)) continue;
    runs.push_back({log});
    runs.back().insert(runs.back().end(), beside[log].begin(), beside[log].end());
  }
  if (runs.empty()) throw Error(ErrorCode::usage, "log", "each of these files is a data file of another one");
  return runs;
}

/// One job for each log, or one for all files if they are of one run.
std::string diagnose_logs(ServiceState& state, SentForm& form) {
  const std::string model = form.field("model");
  if (!state.folder.has_model(model)) throw Error(ErrorCode::usage, "robot", "choose a robot of the list");
  if (form.files().empty()) throw Error(ErrorCode::usage, "log", "choose at least one log");
  const auto files = enum_named(form.field("files"), {RunFiles::columns, RunFiles::rows});
  if (files && form.files().size() > 1) {
    const JobRequest run{JobKind::diagnose, model, form.files(), {}, 0, *files};
    return job_address(form.incoming().add_to(state.queue, run).id);
  }
  const auto runs = files_by_run(form);
  std::int64_t last = 0;
  for (const std::vector<std::string>& run : runs) {
    Incoming incoming(state.folder);
    for (const std::string& file : run)
      std::filesystem::rename(form.incoming().log(file), incoming.log(file));
    last = incoming.add_to(state.queue, {JobKind::diagnose, model, run, {}, 0}).id;
  }
  return runs.size() == 1 ? job_address(last) : robot_address(model);
}

std::string suggest_robot_file(ServiceState& state, SentForm& form) {
  if (form.files().empty()) throw Error(ErrorCode::usage, "log", "choose at least one log");
  std::vector<std::string> logs;
  for (const std::vector<std::string>& run : files_by_run(form)) logs.push_back(run.front());
  return job_address(form.incoming().add_to(state.queue, {JobKind::suggest, "", logs, {}, 0}).id);
}

std::string learn_robot(ServiceState& state, const SentForm& form) {
  static const std::regex plain("[A-Za-z0-9_-]{1,60}");
  const std::string name = form.field("name"), model = name + kModelEnding;
  if (!std::regex_match(name, plain))
    throw Error(ErrorCode::usage, "name", "use 1 to 60 letters, digits, - and _");
  if (!state.folder.is_free_name(model))
    throw Error(ErrorCode::usage, "name", "a robot or a case base of this name exists; choose another name");
  Incoming incoming(state.folder);
  write_file(incoming.file(kSuggestedRobot), form.field("robot"));
  return job_address(
      incoming.add_to(state.queue, {JobKind::learn, model, {}, {number_of(form, "of")}, 0}).id);
}

std::string compare_logs(ServiceState& state, const SentForm& form) {
  const std::string model = form.field("model");
  if (!state.folder.has_model(model)) throw Error(ErrorCode::usage, "robot", "choose a robot of the list");
  const std::int64_t first = number_of(form, "first"), second = number_of(form, "second");
  for (const std::int64_t id : {first, second}) {
    const auto job = state.queue.find(id);
    if (job && job->request.files != RunFiles::single)
      throw Error(ErrorCode::usage, title_of(*job),
                  "is a run of several files; make one file of it first (faultline convert)");
  }
  Incoming incoming(state.folder);
  return job_address(incoming.add_to(state.queue, {JobKind::compare, model, {}, {first, second}, 0}).id);
}

/// Adds what a form asks for, and returns the address of the page to see next.
std::string add_jobs(ServiceState& state, const Request&, SentForm& form) {
  const auto kind =
      enum_named(form.field("kind"), {JobKind::diagnose, JobKind::suggest, JobKind::learn, JobKind::compare});
  if (!kind) throw Error(ErrorCode::usage, "the form", "asks for nothing that this service does");
  switch (*kind) {
    case JobKind::diagnose:
      return diagnose_logs(state, form);
    case JobKind::suggest:
      return suggest_robot_file(state, form);
    case JobKind::learn:
      return learn_robot(state, form);
    case JobKind::compare:
      return compare_logs(state, form);
    case JobKind::record:
      break;
  }
  return "/";
}

Job named_job(const ServiceState& state, const Request& request) {
  const auto job = state.queue.find(std::stoll(request.matches[1]));
  if (!job) throw Error(ErrorCode::usage, "the job", "is not there; it may have been deleted");
  return *job;
}

std::string cancel_job(ServiceState& state, const Request& request, SentForm&) {
  const Job job = named_job(state, request);
  state.queue.cancel(job.id);
  return job_address(job.id);
}

std::string delete_job(ServiceState& state, const Request& request, SentForm&) {
  const Job job = named_job(state, request);
  if (!state.queue.remove(job.id)) throw Error(ErrorCode::usage, "the job", "runs; cancel it first");
  return job.request.kind == JobKind::diagnose && state.folder.has_model(job.request.model)
             ? robot_address(job.request.model)
             : "/";
}

std::string record_run(ServiceState& state, const Request& request, SentForm&) {
  const Job job = named_job(state, request);
  Incoming incoming(state.folder);
  return job_address(incoming.add_to(state.queue, {JobKind::record, job.request.model, {}, {job.id}, 0}).id);
}

std::string store_case(ServiceState& state, const Request& request, SentForm& form) {
  const Job job = named_job(state, request);
  if (job.request.kind != JobKind::diagnose || job.outcome.state != JobState::done)
    throw Error(ErrorCode::usage, "the job", "has no diagnosis");
  const auto joint = whole_number(form.field("joint"));
  if (!joint) throw Error(ErrorCode::usage, "joint", "choose a joint of the list, or none");
  for (const char* field : {"done", "by"})
    if (form.field(field).size() > kLongestStatement)
      throw Error(ErrorCode::usage, field, fmt::format("write at most {} bytes", kLongestStatement));
  CaseStatement statement;
  statement.fault_id = static_cast<int>(number_of(form, "fault_id"));
  statement.kind = form.field("kind");
  statement.joint_number = static_cast<int>(*joint);
  statement.what_was_done = form.field("done");
  statement.person = form.field("by");
  state_case(state.folder.model_path(job.request.model), state.folder.job_path(job.id), statement);
  return job_address(job.id);
}

using FormAction = std::string (*)(ServiceState&, const Request&, SentForm&);

int status_of(const Error& error) {
  if (error.code() == ErrorCode::usage || error.code() == ErrorCode::input) return 422;
  return error.code() == ErrorCode::output ? 507 : 500;
}

void answer_form(ServiceState& state, const Request& request, Response& response, const ContentReader& reader,
                 FormAction action) {
  const std::string session = sent_session(state, request);
  SentForm form;
  const FormAnswer read = read_form(
      request, reader, state.folder, state.options.form,
      [&](const SentForm& so_far) { return state.access.is_form_key(session, so_far.field("key")); }, form);
  if (read.status != 200) return send_refusal(state, request, response, read.status, read.sentence);
  try {
    send_to(request, response, action(state, request, form));
  } catch (const Error& error) {
    send_refusal(state, request, response, status_of(error), error.what());
  }
}

void log_in(ServiceState& state, const Request& request, Response& response, const ContentReader& reader) {
  SentForm form;
  FormLimits limits;
  limits.most_files = 0;
  const FormAnswer read = read_form(
      request, reader, state.folder, limits, [](const SentForm&) { return true; }, form);
  if (read.status != 200) return send_page(response, login_page(read.sentence), read.status);
  if (!state.logins.allows(request.remote_addr))
    return send_page(response, login_page("Too many tries; wait a minute."), 429);
  if (!state.access.needs_token() || !state.access.is_token(form.field("token")))
    return send_page(response, login_page("This is not the token of the service."), 403);
  set_session(state, response, state.access.new_session());
  response.set_redirect("/", 303);
}

/// Ends the session, which the form has shown to be one of this service.
std::string log_out(ServiceState& state, const Request& request, SentForm&) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const std::string session = sent_session(state, request);
  state.folder.add_ended_session(session);
  state.access.end_session(session);
  return "/login";
}

}  // namespace

void add_form_routes(httplib::Server& server, ServiceState& state) {
  const auto post = [&](const char* pattern, FormAction action) {
    server.Post(pattern,
                [&state, action](const Request& request, Response& response, const ContentReader& reader) {
                  answer_form(state, request, response, reader, action);
                });
  };
  post("/jobs", add_jobs);
  post("/jobs/([0-9]{1,12})/cancel", cancel_job);
  post("/jobs/([0-9]{1,12})/delete", delete_job);
  post("/jobs/([0-9]{1,12})/record", record_run);
  post("/jobs/([0-9]{1,12})/case", store_case);
  server.Post("/login", [&state](const Request& request, Response& response, const ContentReader& reader) {
    log_in(state, request, response, reader);
  });
  server.Post("/logout", [&state](const Request& request, Response& response, const ContentReader& reader) {
    set_session(state, response, "");
    answer_form(state, request, response, reader, log_out);
  });
}

}  // namespace faultline
