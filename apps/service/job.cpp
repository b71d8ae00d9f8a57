// SPDX-License-Identifier: MIT
#include "apps/service/job.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "lib/core/atomic_file.hpp"
#include "lib/core/enum_named.hpp"
#include "lib/core/error.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t kLatestMoment_s = 100000000000;           // the year 5138
constexpr std::size_t kMostRequestBytes = std::size_t{1} << 20;  // of a file about a job

std::string request_path(const std::string& folder) { return folder + "/request.json"; }
std::string outcome_path(const std::string& folder) { return folder + "/outcome.json"; }

JobRequest request_from(const Json& json) {
  JobRequest request;
  const auto kind =
      enum_named(json.at("kind").get<std::string>(),
                 {JobKind::diagnose, JobKind::record, JobKind::suggest, JobKind::learn, JobKind::compare});
  if (!kind) throw Error(ErrorCode::input, "kind", "is unknown");
  request.kind = *kind;
  request.model = json.at("model").get<std::string>();
  request.logs = json.at("logs").get<std::vector<std::string>>();
  request.of = json.at("of").get<std::vector<std::int64_t>>();
  const Json& received = json.at("received_s");
  if (!received.is_number_integer() || received.get<std::int64_t>() < 0 ||
      received.get<std::int64_t>() > kLatestMoment_s)
    throw Error(ErrorCode::input, "received_s", "is no time");
  request.received_s = received.get<std::int64_t>();
  const auto files = enum_named(json.value("files", to_string(RunFiles::single)),
                                {RunFiles::single, RunFiles::columns, RunFiles::rows});
  if (!files) throw Error(ErrorCode::input, "files", "is unknown");
  request.files = *files;
  return request;
}

JobOutcome outcome_from(const Json& json) {
  const auto state = enum_named(json.at("state").get<std::string>(),
                                {JobState::done, JobState::failed, JobState::cancelled});
  if (!state) throw Error(ErrorCode::input, "state", "is unknown");
  return {*state, json.at("verdict").get<std::string>(), json.at("sentence").get<std::string>()};
}

/// A damaged outcome counts as none: the job runs again.
JobOutcome kept_outcome(const std::string& folder) {
  if (!std::filesystem::exists(outcome_path(folder))) return {};
  try {
    return outcome_from(Json::parse(read_file(outcome_path(folder), kMostRequestBytes)));
  } catch (const nlohmann::json::exception&) {
    return {};
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

const char* to_string(JobKind kind) {
  switch (kind) {
    case JobKind::diagnose:
      return "diagnose";
    case JobKind::record:
      return "record";
    case JobKind::suggest:
      return "suggest";
    case JobKind::learn:
      return "learn";
    case JobKind::compare:
      return "compare";
  }
  return "";
}

const char* to_string(RunFiles files) {
  switch (files) {
    case RunFiles::single:
      return "single";
    case RunFiles::columns:
      return "columns";
    case RunFiles::rows:
      return "rows";
  }
  return "";
}

const char* to_string(JobState state) {
  switch (state) {
    case JobState::waiting:
      return "waiting";
    case JobState::running:
      return "running";
    case JobState::done:
      return "done";
    case JobState::failed:
      return "failed";
    case JobState::cancelled:
      return "cancelled";
  }
  return "";
}

std::string title_of(const Job& job) {
  const JobRequest& request = job.request;
  switch (request.kind) {
    case JobKind::diagnose:
      if (request.logs.empty()) return "Damaged job";
      if (request.files == RunFiles::single) return request.logs[0];
      return request.logs[0] + " and " +
             counted(static_cast<long long>(request.logs.size()) - 1, "more file");
    case JobKind::record:
      return fmt::format("Recording of run {}", request.of.at(0));
    case JobKind::suggest:
      return "New robot from " + counted(static_cast<long long>(request.logs.size()), "log");
    case JobKind::learn:
      return "Learning of " + request.model;
    case JobKind::compare:
      return fmt::format("Runs {} and {} compared", request.of.at(0), request.of.at(1));
  }
  return "";
}

void write_request(const std::string& folder, const JobRequest& request) {
  const Json json{{"kind", to_string(request.kind)},
                  {"model", request.model},
                  {"logs", request.logs},
                  {"of", request.of},
                  {"received_s", request.received_s},
                  {"files", to_string(request.files)}};
  write_file(request_path(folder), json_text(json));
}

void write_outcome(const std::string& folder, const JobOutcome& outcome) {
  const Json json{{"state", to_string(outcome.state)},
                  {"verdict", outcome.verdict},
                  {"sentence", valid_utf8(outcome.sentence)}};
  write_file(outcome_path(folder), json_text(json));
}

Job read_job(const std::string& folder, std::int64_t id) {
  Job job;
  job.id = id;
  try {
    job.request = request_from(Json::parse(read_file(request_path(folder), kMostRequestBytes)));
    const std::size_t needed = job.request.kind == JobKind::compare ? 2
                               : job.request.kind == JobKind::record || job.request.kind == JobKind::learn
                                   ? 1
                                   : 0;
    if (job.request.of.size() != needed || (needed == 0 && job.request.logs.empty()))
      throw Error(ErrorCode::input, "of", "does not fit the kind");
    job.outcome = kept_outcome(folder);
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorCode::input, folder, std::string("is no job of faultline serve: ") + error.what());
  }
  return job;
}

}  // namespace faultline
