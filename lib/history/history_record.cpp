// SPDX-License-Identifier: MIT
#include "lib/history/history_record.hpp"

#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kDiagnosisSchema = "faultline/diagnosis/1";
constexpr std::size_t kHashLength = 64;  // hexadecimal digits of SHA-256

std::string hash_from(const Json& owner, const char* what) {
  const auto hash = owner.at("sha256").get<std::string>();
  if (hash.size() == kHashLength && hash.find_first_not_of("0123456789abcdef") == std::string::npos)
    return hash;
  throw Error(ErrorCode::input, what,
              "lacks its SHA-256, by which a history knows it; diagnose the log again from its file");
}

HistoryRecord parsed(const Json& json) {
  HistoryRecord record;
  const Json &log = json.at("log"), &model = json.at("model");
  record.log_sha256 = hash_from(log, "log");
  record.model_sha256 = hash_from(model, "model");
  record.robot = valid_utf8(model.at("name").get<std::string>());
  record.log = valid_utf8(log.at("path").get<std::string>());
  record.verdict = json.at("verdict").get<std::string>();
  record.start_s = number_or_nan(log.at("start_s"));
  record.end_s = number_or_nan(log.at("end_s"));
  for (const Json& fault : json.at("faults"))
    record.findings.push_back({fault.at("kind").get<std::string>(),
                               Joint::numbered(count_or_zero(fault.at("joint"))),
                               number_or_nan(fault.at("onset_s")), number_or_nan(fault.at("confidence"))});
  for (const Json& item : json.at("condition"))
    record.condition.push_back({item.at("name").get<std::string>(),
                                number_or_nan(item.at("value")),
                                {number_or_nan(item.at("ci95").at(0)), number_or_nan(item.at("ci95").at(1))},
                                number_or_nan(item.at("normal_range")),
                                item.at("unit").get<std::string>()});
  return record;
}

}  // namespace

bool is_diagnosis_json(const std::string& text) {
  constexpr std::size_t kSchemaWithin = 200;  // bytes; the schema is the first member
  return text.substr(0, kSchemaWithin).find(kDiagnosisSchema) != std::string::npos;
}

HistoryRecord history_record(const std::string& text, const std::string& where) try {
  refuse_deep_json(text, where);
  const Json json = Json::parse(text);
  if (!json.is_object() || json.value("schema", "") != kDiagnosisSchema)
    throw Error(ErrorCode::input, where,
                std::string("is no diagnosis (its schema is not \"") + kDiagnosisSchema +
                    "\"); give folders of faultline batch, or files of faultline diagnose --json");
  return parsed(json);
} catch (const nlohmann::json::exception&) {
  throw Error(ErrorCode::input, where,
              "is no complete JSON report of faultline diagnose; write it again, or leave it out");
} catch (const Error& error) {
  if (error.where() == where) throw;
  throw Error(ErrorCode::input, where, std::string(error.what()));
}

std::string digest_of(const HistoryRecord& r) {
  Json json = {r.log_sha256,
               r.model_sha256,
               r.robot,
               r.log,
               r.verdict,
               number_or_null(r.start_s),
               number_or_null(r.end_s),
               Json::array(),
               Json::array()};
  Json& findings = json[json.size() - 2];
  for (const HistoryFinding& f : r.findings)
    findings.push_back({f.kind, f.joint.number(), number_or_null(f.onset_s), number_or_null(f.confidence)});
  Json& condition = json.back();
  for (const HistoryCondition& c : r.condition)
    condition.push_back({c.name, number_or_null(c.value), number_or_null(c.ci95[0]),
                         number_or_null(c.ci95[1]), number_or_null(c.normal_range), c.unit});
  return sha256_hex(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace faultline
