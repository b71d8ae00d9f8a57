// SPDX-License-Identifier: MIT
#include "lib/batch/batch_facts.hpp"

#include <nlohmann/json.hpp>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/utf8.hpp"

namespace faultline {

using Json = nlohmann::ordered_json;

bool BatchFacts::operator==(const BatchFacts& other) const {
  return settings_of(*this) == settings_of(other) && logs == other.logs && shard == other.shard &&
         shards == other.shards;
}

std::string settings_of(const BatchFacts& facts) {
  std::string text = "faultline/batch/1\n";
  for (const std::string& part :
       {facts.program_version, facts.model.name, facts.model.sha256, facts.model.cases_sha256, facts.options})
    text += std::to_string(part.size()) + " " + part + "\n";
  return sha256_hex(text);
}

std::string facts_to_json(const BatchFacts& facts) {
  Json model{{"name", valid_utf8(facts.model.name)},
             {"sha256", facts.model.sha256},
             {"cases_sha256", facts.model.cases_sha256}};
  if (!facts.model.notes.empty()) model["notes"] = facts.model.notes;
  return Json{{"schema", "faultline/batch/1"},
              {"model", model},
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
    BatchFacts facts;
    facts.model = {json.at("model").at("name"), json.at("model").at("sha256"),
                   json.at("model").at("cases_sha256")};
    if (json["model"].contains("notes")) facts.model.notes = json["model"]["notes"];
    facts.program_version = json.at("program").at("version");
    facts.options = json.at("options");
    facts.logs = json.at("logs");
    facts.shard = json.at("shard");
    facts.shards = json.at("shards");
    return facts;
  } catch (const nlohmann::json::exception&) {
    throw Error(ErrorCode::input, path, "does not describe a finished batch; run the batch again");
  }
}

}  // namespace faultline
