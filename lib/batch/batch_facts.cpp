// SPDX-License-Identifier: MIT
#include "lib/batch/batch_facts.hpp"

#include <nlohmann/json.hpp>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/utf8.hpp"

namespace faultline {

using Json = nlohmann::ordered_json;

namespace {

constexpr const char* kSchema = "faultline/batch/2";

Json model_json(const ModelFacts& model) {
  Json json{{"name", valid_utf8(model.name)}, {"sha256", model.sha256}, {"cases_sha256", model.cases_sha256}};
  if (!model.notes.empty()) json["notes"] = model.notes;
  if (!model.grave_doubts.empty()) json["grave_doubts"] = model.grave_doubts;
  return json;
}

ModelFacts model_from(const Json& json) {
  ModelFacts model{json.at("name"), json.at("sha256"), json.at("cases_sha256")};
  if (json.contains("notes")) model.notes = json["notes"];
  if (json.contains("grave_doubts")) model.grave_doubts = json["grave_doubts"];
  return model;
}

}  // namespace

bool BatchFacts::operator==(const BatchFacts& other) const {
  return settings_of(*this) == settings_of(other) && logs == other.logs && shard == other.shard &&
         shards == other.shards;
}

std::string settings_of(const BatchFacts& facts) {
  std::string text;
  for (const ModelFacts& model : facts.models) text += settings_of(facts, model) + "\n";
  return sha256_hex(text);
}

std::string settings_of(const BatchFacts& facts, const ModelFacts& model) {
  std::string text = std::string(kSchema) + "\n";
  for (const std::string& part :
       {facts.program_version, model.name, model.sha256, model.cases_sha256, facts.options})
    text += std::to_string(part.size()) + " " + part + "\n";
  return sha256_hex(text);
}

std::string facts_to_json(const BatchFacts& facts) {
  Json models = Json::array();
  for (const ModelFacts& model : facts.models) models.push_back(model_json(model));
  return Json{{"schema", kSchema},
              {"models", models},
              {"program", {{"version", facts.program_version}}},
              {"options", facts.options},
              {"logs", facts.logs},
              {"shard", facts.shard},
              {"shards", facts.shards}}
             .dump(2) +
         "\n";
}

BatchFacts read_facts(const std::string& path) {
  const std::string text = read_file(path);
  try {
    const Json json = Json::parse(text);
    if (json.at("schema") != kSchema)
      throw Error(ErrorCode::input, path,
                  std::string("has another schema, this program reads ") + kSchema + "; run the batch again");
    BatchFacts facts;
    for (const Json& model : json.at("models")) facts.models.push_back(model_from(model));
    facts.program_version = json.at("program").at("version");
    facts.options = json.at("options");
    facts.logs = json.at("logs");
    facts.shard = json.at("shard");
    facts.shards = json.at("shards");
    if (facts.logs >= 0) return facts;
  } catch (const nlohmann::json::exception&) {
    // said below
  }
  throw Error(ErrorCode::input, path, "does not describe a finished batch; run the batch again");
}

}  // namespace faultline
