// SPDX-License-Identifier: MIT
#include "lib/batch/batch_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/json/json_fields.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/core/statistics.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFactsSchema = "faultline/batch/2";

constexpr std::size_t kShownReasons = 5;  // more would push the counts off the terminal

void count_verdict(BatchCounts& counts, const BatchRow& row) {
  ++counts.logs;
  counts.healthy += row.verdict == "healthy";
  counts.faulty += row.verdict == "faulty";
  counts.inconclusive += row.verdict == "inconclusive";
  counts.unusable += row.verdict == "unusable";
  counts.failed += row.verdict == "failed";
  counts.faults += static_cast<int>(row.faults.size());
  const bool judged = row.verdict == "healthy" || row.verdict == "faulty";
  if (judged && std::isfinite(row.end_s - row.start_s)) counts.hours += (row.end_s - row.start_s) / 3600.0;
}

BatchCounts counts_of(const std::vector<const BatchRow*>& rows) {
  BatchCounts counts;
  std::vector<double> residuals;
  for (const BatchRow* row : rows) {
    count_verdict(counts, *row);
    if (const double level = residual_level(*row); std::isfinite(level)) residuals.push_back(level);
  }
  counts.median_residual = upper_median(residuals);
  counts.largest_residual = residuals.empty() ? std::numeric_limits<double>::quiet_NaN()
                                              : *std::max_element(residuals.begin(), residuals.end());
  return counts;
}

Json counts_json(const BatchCounts& c) {
  return {{"logs", c.logs},
          {"healthy", c.healthy},
          {"faulty", c.faulty},
          {"inconclusive", c.inconclusive},
          {"unusable", c.unusable},
          {"failed", c.failed},
          {"faults", c.faults},
          {"hours", number_or_null(c.hours)},
          {"faults_per_hour", c.hours > 0.0 ? number_or_null(c.faults / c.hours) : Json(nullptr)},
          {"median_residual", number_or_null(c.median_residual)},
          {"largest_residual", number_or_null(c.largest_residual)}};
}

Json kinds_json(const BatchSummary& summary) {
  Json json = Json::array();
  for (const auto& [kind, joints] : summary.kinds)
    for (const auto& [joint, count] : joints)
      json.push_back({{"kind", kind}, {"joint", count_or_null(joint.number())}, {"count", count}});
  return json;
}

Json models_json(const BatchSummary& summary) {
  Json models = Json::array();
  for (const ModelFacts& model : summary.facts.models) {
    Json json = {{"name", model.name}, {"sha256", model.sha256}, {"cases_sha256", model.cases_sha256}};
    const auto counts = summary.models.find(model.sha256);
    json.update(counts_json(counts == summary.models.end() ? counts_of({}) : counts->second));
    models.push_back(std::move(json));
  }
  return models;
}

/// Condition from log to log, for each model that has logs.
std::vector<RobotWear> wear_of(const std::vector<BatchRow>& rows, const BatchSummary& summary) {
  std::vector<RobotWear> all;
  for (const ModelFacts& model : summary.facts.models) {
    if (!summary.models.contains(model.sha256)) continue;
    std::vector<WearLog> logs;
    for (const BatchRow& row : rows)
      if (row.model_sha256 == model.sha256) logs.push_back({row.log, row.start_s, row.condition});
    all.push_back(robot_wear(model.name, model.sha256, std::move(logs)));
  }
  return all;
}

void compare_twins(BatchSummary& summary) {
  summary.robots.not_applicable = "the batch has one model";
  summary.joints.not_applicable = "no pairs of joints are given (--twins)";
  if (summary.wear.size() > 1) summary.robots = compare_robots(summary.wear);
  const std::vector<JointPair> pairs = joint_pairs(summary.facts.twins, "--twins");
  if (!pairs.empty()) summary.joints = compare_joints(summary.wear, pairs);
}

/// The first logs without a diagnosis with their reasons, and where the others stand.
std::string reasons_text(const std::vector<LogWithoutDiagnosis>& logs) {
  std::string text;
  for (const LogWithoutDiagnosis& log :
       std::span(logs).first(std::min<std::size_t>(logs.size(), kShownReasons)))
    text += fmt::format("  not diagnosed: {}: {}\n", brief(log.log), brief(log.reason));
  if (logs.size() > kShownReasons)
    text += fmt::format("  and {} more without a diagnosis; index.csv lists the reason of each\n",
                        logs.size() - kShownReasons);
  return text;
}

}  // namespace

void fields(auto& v, MaybeConst<ModelFacts> auto& model) {
  v.text("name", model.name);
  v("sha256", model.sha256);
  v("cases_sha256", model.cases_sha256);
  v.unless_empty("notes", model.notes);
  v.unless_empty("grave_doubts", model.grave_doubts);
}

void fields(auto& v, MaybeConst<BatchFacts> auto& facts) {
  v("models", facts.models);
  v.object("program", [&](auto& program) { program("version", facts.program_version); });
  v("options", facts.options);
  v("logs", facts.logs);
  v("shard", facts.shard);
  v("shards", facts.shards);
  v.unless_empty("twins", facts.twins);
}

std::string settings_of(const BatchFacts& facts) {
  std::string text;
  for (const ModelFacts& model : facts.models) text += settings_of(facts, model) + "\n";
  return sha256_hex(text);
}

std::string settings_of(const BatchFacts& facts, const ModelFacts& model) {
  std::string text = std::string(kFactsSchema) + "\n";
  for (const std::string& part :
       {facts.program_version, model.name, model.sha256, model.cases_sha256, facts.options})
    text += std::to_string(part.size()) + " " + part + "\n";
  return sha256_hex(text);
}

std::string facts_to_json(const BatchFacts& facts) {
  FieldWriter<Json> writer;
  writer("schema", kFactsSchema);
  fields(writer, facts);
  return writer.json().dump(2) + "\n";
}

BatchFacts read_facts(const std::string& path) {
  const std::string text = read_file(path);
  try {
    const Json json = Json::parse(text);
    if (json.at("schema") != kFactsSchema)
      throw Error(
          ErrorCode::input, path,
          std::string("has another schema, this program reads ") + kFactsSchema + "; run the batch again");
    auto facts = fields_from_json<BatchFacts>(json, path);
    if (facts.logs >= 0) return facts;
  } catch (const nlohmann::json::exception&) {
    // said below
  }
  throw Error(ErrorCode::input, path, "does not describe a finished batch; run the batch again");
}

BatchSummary summary_of(const std::vector<BatchRow>& rows, const BatchFacts& facts) {
  BatchSummary summary;
  summary.facts = facts;
  std::vector<const BatchRow*> all;
  std::map<std::string, std::vector<const BatchRow*>> folders, models;
  for (const BatchRow& row : rows) {
    all.push_back(&row);
    folders[folder_of(row)].push_back(&row);
    models[row.model_sha256].push_back(&row);
    for (const FaultEvent& fault : row.faults)
      ++summary.kinds[to_string(fault.label.kind)][fault.label.joint];
    if (row.verdict == "unusable" || row.verdict == "failed")
      summary.not_diagnosed.push_back({row.log, row.reason});
    summary.status = std::max(summary.status, status_of(row));
  }
  summary.all = counts_of(all);
  for (const auto& [model, members] : models) summary.models[model] = counts_of(members);
  for (const auto& [folder, members] : folders) summary.folders[folder] = counts_of(members);
  summary.wear = wear_of(rows, summary);
  compare_twins(summary);
  return summary;
}

std::string to_json(const BatchSummary& summary) {
  Json folders = Json::array();
  for (const auto& [folder, counts] : summary.folders) {
    Json json = {{"folder", folder}};
    json.update(counts_json(counts));
    folders.push_back(json);
  }
  const BatchFacts& facts = summary.facts;
  const Json json = {
      {"schema", "faultline/batch-summary/2"},
      {"models", models_json(summary)},
      {"program", {{"version", facts.program_version}}},
      {"options", facts.options},
      {"shard", facts.shard},
      {"shards", facts.shards},
      {"exit_status", summary.status},
      {"all", counts_json(summary.all)},
      {"faults", kinds_json(summary)},
      {"folders", folders},
      {"wear", list_of<Json>(summary.wear, [](const RobotWear& wear) { return to_json(wear, false); })},
      {"twins", {{"robots", to_json(summary.robots)}, {"joints", to_json(summary.joints)}}}};
  return json_text(json);
}

std::string to_text(const BatchSummary& summary) {
  const BatchCounts& all = summary.all;
  std::string text =
      fmt::format("{}: {} healthy, {} faulty, {} inconclusive, {} unusable", counted(all.logs, "log"),
                  all.healthy, all.faulty, all.inconclusive, all.unusable);
  text += all.failed > 0 ? fmt::format(", {} failed because of a defect of faultline\n", all.failed) : "\n";
  for (const auto& [kind, joints] : summary.kinds)
    for (const auto& [joint, count] : joints)
      text += fmt::format("  {:>6}  {}{}\n", count, kind,
                          joint.is_none() ? "" : fmt::format(", joint {}", joint));
  for (const ModelFacts& model : summary.facts.models)
    for (const std::string& doubt : model.grave_doubts)
      text += fmt::format("  no log can be called healthy by {}: {}\n", brief(model.name), brief(doubt));
  for (const RobotWear& wear : summary.wear) text += to_text(wear);
  text += to_text(summary.robots) + to_text(summary.joints);
  return text + reasons_text(summary.not_diagnosed);
}

}  // namespace faultline
