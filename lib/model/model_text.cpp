// SPDX-License-Identifier: MIT
#include "lib/model/model_text.hpp"

#include <cstdlib>

#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchemaName = "faultline/model/";
constexpr const char *kBeforeDigest = ",\n \"digest\": \"", *kAfterDigest = "\"\n}\n";

std::string with_digest(const std::string& before) {
  return before + kBeforeDigest + sha256_hex(before) + kAfterDigest;
}

bool digest_fits(const std::string& text) {
  const std::size_t begin = text.rfind(kBeforeDigest);
  return begin != std::string::npos && text == with_digest(text.substr(0, begin));
}

/// Returns the schema version; 0 if the JSON is no model, -1 if its version is not valid.
int version_of(const Json& json) {
  const bool named = json.is_object() && json.contains("schema") && json["schema"].is_string();
  const std::string schema = named ? json["schema"].get<std::string>() : "";
  if (schema.rfind(kSchemaName, 0) != 0) return 0;
  const int version = std::atoi(schema.c_str() + std::string(kSchemaName).size());
  return schema == model_schema(version) ? version : -1;
}

[[noreturn]] void refuse(const std::string& where, const std::string& message) {
  throw Error(ErrorCode::input, where, message);
}

Json parsed(const std::string& text, const std::string& where) {
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded())
    refuse(where,
           "is not a complete JSON file: it is truncated, damaged or not a model; `faultline learn` writes a "
           "model");
  return json;
}

void check_version(const Json& json, const std::string& where) {
  const int version = version_of(json);
  if (version == 0) refuse(where, "is JSON, but not a faultline model; `faultline learn` writes a model");
  const std::string schema = json["schema"].get<std::string>().substr(0, 40);
  if (version > kModelVersion)
    refuse(where, "has schema " + schema + ", this program reads " + model_schema(kModelVersion) +
                      "; use a newer faultline or learn the model again");
  if (version < kModelVersion)
    refuse(where,
           "has the schema \"" + valid_utf8(schema) + "\" of an earlier program; learn the model again");
}

std::string digest_in(const Json& json) {
  if (!json.contains("digest") || !json["digest"].is_string()) return "";
  return json["digest"].get<std::string>();
}

}  // namespace

std::string model_schema(int version) { return kSchemaName + std::to_string(version); }

std::string sealed_model_text(const Json& content) {
  const std::string text = content.dump(1);
  return with_digest(text.substr(0, text.rfind("\n}")));
}

nlohmann::json read_model_text(const std::string& text, const std::string& where) {
  const Json json = parsed(text, where);
  check_version(json, where);
  if (!digest_fits(text))
    refuse(where,
           "does not match its own digest: it is a damaged model, or was edited. Restore it from a copy or "
           "learn it again; if it was edited on purpose, accept it with `faultline model sign`");
  return nlohmann::json(json);
}

std::string signed_model_text(const std::string& text, const std::string& why, const std::string& where) {
  Json json = parsed(text, where);
  check_version(json, where);
  if (digest_fits(text)) return text;
  const Json edit = {{"digest_before", digest_in(json)}, {"why", valid_utf8(why)}};
  json.erase("digest");
  if (!json["edited"].is_array()) json["edited"] = Json::array();
  json["edited"].push_back(edit);
  return sealed_model_text(json);
}

}  // namespace faultline
