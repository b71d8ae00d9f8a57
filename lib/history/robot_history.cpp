// SPDX-License-Identifier: MIT
#include "lib/history/robot_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/core/statistics.hpp"
#include "lib/core/text.hpp"
#include "lib/core/version.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

using Records = std::vector<const HistoryRecord*>;
using Json = nlohmann::ordered_json;

/// Sorts by date if all records have one; else they keep the order in which they were added.
void sort_by_date(Records& records) {
  if (!std::all_of(records.begin(), records.end(), [](const auto* r) { return is_date(r->start_s); })) return;
  std::stable_sort(records.begin(), records.end(),
                   [](const auto* a, const auto* b) { return a->start_s < b->start_s; });
}

WearLog wear_log(const HistoryRecord& record) {
  WearLog log{record.log, record.start_s, {}};
  for (const HistoryCondition& item : record.condition)
    if (item.is_determined())
      log.condition.push_back({item.name, item.value, (item.ci95[1] - item.value) / kNormal95, item.unit});
  return log;
}

void count(RobotHistory& robot, const HistoryRecord& record) {
  ++robot.logs;
  robot.healthy += record.verdict == "healthy";
  robot.faulty += record.verdict == "faulty";
  robot.inconclusive += record.verdict == "inconclusive";
  for (const HistoryFinding& finding : record.findings)
    if (!robot.worst || !(finding.confidence < robot.worst->finding.confidence))
      robot.worst = WorstFinding{finding, record.log, record.start_s};
}

RobotHistory history_of(const std::string& name, Records records) {
  sort_by_date(records);
  const std::string model = records.back()->model_sha256;
  const auto others = std::erase_if(records, [&](const auto* r) { return r->model_sha256 != model; });
  RobotHistory robot;
  robot.robot = name;
  robot.of_other_models = static_cast<int>(others);
  sort_by_date(records);
  std::vector<WearLog> logs;
  for (const HistoryRecord* record : records) {
    count(robot, *record);
    logs.push_back(wear_log(*record));
  }
  robot.last_log = records.back()->log;
  robot.last_start_s = records.back()->start_s;
  robot.wear = robot_wear(name, model, std::move(logs));
  return robot;
}

Json finding_json(const RobotHistory& robot) {
  if (!robot.worst) return nullptr;
  const WorstFinding& worst = *robot.worst;
  return {{"kind", worst.finding.kind},
          {"joint", count_or_null(worst.finding.joint.number())},
          {"confidence", number_or_null(worst.finding.confidence)},
          {"onset_s", number_or_null(worst.finding.onset_s)},
          {"log", worst.log},
          {"start_s", number_or_null(worst.start_s)}};
}

Json robot_json(const RobotHistory& robot) {
  return {{"robot", robot.robot},
          {"logs", robot.logs},
          {"healthy", robot.healthy},
          {"faulty", robot.faulty},
          {"inconclusive", robot.inconclusive},
          {"results_of_other_models", robot.of_other_models},
          {"last", {{"log", robot.last_log}, {"start_s", number_or_null(robot.last_start_s)}}},
          {"worst_finding", finding_json(robot)},
          {"wear", to_json(robot.wear, true)}};
}

}  // namespace

std::vector<RobotHistory> robot_histories(const std::vector<HistoryRecord>& records,
                                          const std::vector<std::string>& selected) {
  std::map<std::string, Records> by_name;
  for (const HistoryRecord& record : records) by_name[record.robot].push_back(&record);
  for (const std::string& name : selected)
    if (!by_name.contains(name)) {
      std::string known;
      for (const auto& [robot, of_robot] : by_name) known += (known.empty() ? "" : ", ") + robot;
      throw Error(ErrorCode::usage, "--robot " + name,
                  "is no robot of this history; it contains " + (known.empty() ? "no robot" : known));
    }
  std::vector<RobotHistory> robots;
  for (auto& [name, of_robot] : by_name)
    if (selected.empty() || std::find(selected.begin(), selected.end(), name) != selected.end())
      robots.push_back(history_of(name, std::move(of_robot)));
  return robots;
}

std::string worst_words(const RobotHistory& robot) {
  if (!robot.worst) return "none";
  const HistoryFinding& finding = robot.worst->finding;
  const std::string date = date_text(robot.worst->start_s);
  return fmt::format("{}{}, confidence {} ({}{})", finding.kind,
                     finding.joint.is_none() ? "" : fmt::format(", joint {}", finding.joint),
                     percent_text(finding.confidence), date.empty() ? "" : date + ", ",
                     shortened(robot.worst->log, kLongestName));
}

std::string to_text(const std::vector<RobotHistory>& robots) {
  std::string text;
  for (const RobotHistory& robot : robots) {
    const std::string date = date_text(robot.last_start_s);
    text += fmt::format("{}: {}, last {}; worst finding: {}\n", shortened(robot.robot, kLongestName),
                        counted(robot.logs, "log"),
                        date.empty() ? shortened(robot.last_log, kLongestName) : date, worst_words(robot));
    if (!robot.wear.not_applicable.empty())
      text += "  wear: not applicable, " + robot.wear.not_applicable + "\n";
    text += to_text(robot.wear);
  }
  return text;
}

std::string history_json(const std::vector<RobotHistory>& robots) {
  return json_text({{"schema", "faultline/history/1"},
                    {"program", {{"version", program_version()}}},
                    {"robots", list_of<Json>(robots, robot_json)}});
}

}  // namespace faultline
