// SPDX-License-Identifier: MIT
#include "apps/service/stated_cases.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>

#include "apps/cases/case_actions.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

std::string statements_path(const std::string& job_folder) { return job_folder + "/cases.json"; }

Json read_statements(const std::string& job_folder) {
  const std::string path = statements_path(job_folder);
  return std::filesystem::exists(path) ? Json::parse(read_file(path)) : Json::array();
}

/// "case 91: joint 1 was hit or pushed, stated by Weber; done: removed the box".
std::string case_words(const Json& c) {
  const auto text_of = [&](const char* name) {
    return c.at(name).is_null() ? "" : c.at(name).get<std::string>();
  };
  const Json& joint = c.at("label").at("joint");
  const FaultLabel label{fault_kind_from(c.at("label").at("kind").get<std::string>()),
                         Joint::numbered(joint.is_null() ? 0 : joint.get<int>())};
  std::string text = fmt::format("case {}: {}", c.at("id").get<std::int64_t>(), plain_words(label));
  if (const std::string person = text_of("person"); !person.empty()) text += ", stated by " + person;
  if (const std::string done = text_of("what_was_done"); !done.empty()) text += "; done: " + done;
  return text;
}

}  // namespace

StatedCase state_case(const std::string& model, const std::string& job_folder,
                      const CaseStatement& statement) {
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
  const std::string text = case_words(answer.json);
  Json all = read_statements(job_folder);
  all.push_back({{"fault_id", statement.fault_id}, {"text", text}});
  write_file(statements_path(job_folder), json_text(all));
  return {statement.fault_id, text};
}

std::vector<StatedCase> read_stated_cases(const std::string& job_folder) {
  std::vector<StatedCase> cases;
  for (const Json& one : read_statements(job_folder))
    cases.push_back({one.at("fault_id").get<int>(), one.at("text").get<std::string>()});
  return cases;
}

}  // namespace faultline
