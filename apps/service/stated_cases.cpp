// SPDX-License-Identifier: MIT
#include "apps/service/stated_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>

#include "apps/cases/case_actions.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

std::string statements_path(const std::string& job_folder) { return job_folder + "/cases.json"; }

/// The case of each fault of a job; empty if none was stated, or if the file is damaged.
std::map<int, std::int64_t> read_statements(const std::string& job_folder) {
  const std::string path = statements_path(job_folder);
  std::map<int, std::int64_t> cases;
  if (!std::filesystem::exists(path)) return cases;
  try {
    for (const Json& one : Json::parse(read_file(path)))
      cases[one.at("fault_id").get<int>()] = one.at("case").get<std::int64_t>();
  } catch (const nlohmann::json::exception&) {
    return {};
  }
  return cases;
}

void write_statements(const std::string& job_folder, const std::map<int, std::int64_t>& cases) {
  Json json = Json::array();
  for (const auto& [fault_id, id] : cases) json.push_back({{"fault_id", fault_id}, {"case", id}});
  write_file(statements_path(job_folder), json_text(json));
}

/// "case 91: joint 1 was hit or pushed, stated by Weber; done: removed the box".
std::string case_words(const CaseBase& base, std::int64_t id) {
  const auto found =
      std::find_if(base.cases().begin(), base.cases().end(), [id](const Case& c) { return c.id == id; });
  if (found == base.cases().end())
    return fmt::format("case {}, which was deleted from the case base since", id);
  std::string text = fmt::format("case {}: {}", id, plain_words(found->label));
  if (!found->person.empty()) text += ", stated by " + found->person;
  if (!found->what_was_done.empty()) text += "; done: " + found->what_was_done;
  return text;
}

}  // namespace

void state_case(const std::string& model, const std::string& job_folder, const CaseStatement& statement) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  CasesArguments arguments;
  arguments.model = model;
  arguments.diagnosis_text = read_file(job_folder + "/" + kReportJson);
  arguments.fault_id = statement.fault_id;
  arguments.fault = statement.kind;
  arguments.joint_number = statement.joint_number;
  arguments.done = statement.what_was_done;
  arguments.by = statement.person;
  const CasesAnswer answer = add_case(arguments);
  std::map<int, std::int64_t> cases = read_statements(job_folder);
  cases[statement.fault_id] = answer.json.at("id").get<std::int64_t>();
  write_statements(job_folder, cases);
}

std::vector<StatedCase> stated_cases(const std::string& model, const std::string& job_folder) {
  std::vector<StatedCase> stated;
  const std::map<int, std::int64_t> cases = read_statements(job_folder);
  if (cases.empty()) return stated;
  const CaseBase base = read_case_base(case_base_path(model));
  for (const auto& [fault_id, id] : cases) stated.push_back({fault_id, case_words(base, id)});
  return stated;
}

}  // namespace faultline
