// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <exception>
#include <nlohmann/json.hpp>
#include <string_view>

#include "lib/cases/case_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/inner_file.hpp"
#include "lib/core/json/json_fields.hpp"
#include "lib/core/json_values.hpp"
#include "lib/fault/label_fields.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "faultline/cases/1";

constexpr std::size_t kLongestJsonWord = 24;
constexpr int kMissingMember = 403, kNumberOverflow = 406;  // error numbers of nlohmann::json

Json feature_values(const CaseBase& base, const Case& c) {
  Json values = Json::object();
  for (std::size_t i = 0; i < c.episode.features.size(); ++i)
    values[base.metric().features[i].name] = number_or_null(c.episode.features[i]);
  return values;
}

std::vector<double> features_from(const Json& json, const std::vector<Feature>& features) {
  if (json.size() != features.size())
    throw Error(
        ErrorCode::input, "features",
        std::to_string(json.size()) + " values, " + std::to_string(features.size()) + " were expected");
  std::vector<double> values;
  for (const Feature& f : features) values.push_back(number_or_nan(json.at(f.name)));
  return values;
}

}  // namespace

void fields(auto& v, MaybeConst<Feature> auto& feature) {
  v("name", feature.name);
  v.finite("scale", feature.scale);
  v.finite("weight", feature.weight);
}

/// All but the features, which the metric names.
void fields(auto& v, MaybeConst<Case> auto& c) {
  v("id", c.id);
  v("label", c.label);
  v("decision", c.decision);
  v.named("outcome", c.outcome, case_outcome_from);
  v("what_was_done", c.what_was_done);
  v("origin", c.origin);
  v.unless_empty("log_sha256", c.log_sha256);
  v.unless_empty("onset_s", c.onset_s);
  v.unless_empty("features_by", c.features_by);
  v.unless_empty("log_name", c.log_name);
  v.unless_empty("robot", c.robot);
  v.unless_empty("person", c.person);
  v.unless_empty("date", c.date);
  v.object("opinions", [&](auto& opinions) {
    opinions("mlp", c.episode.mlp);
    opinions("rbfn", c.episode.rbfn);
  });
  v("evidence", c.episode.evidence);
}

namespace {

Case case_from(const Json& json, const std::vector<Feature>& features) {
  auto c = fields_from_json<Case>(json, "case");
  if (!c.origin.empty() && !is_plain_log_name(c.origin))
    throw Error(
        ErrorCode::input, "case " + std::to_string(c.id),
        "its origin \"" + c.origin +
            "\" is not the name of a log, as it leads out of a folder; write the name of the log there");
  c.episode.features = features_from(json.at("features"), features);
  return c;
}

bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'; }

/// Returns the word, or else the character, around byte `at`.
std::string word_at(std::string_view text, std::size_t at) {
  std::size_t begin = at, end = at;
  while (begin > 0 && at - begin < kLongestJsonWord && is_of_word(text[begin - 1])) --begin;
  while (end < text.size() && end - begin < kLongestJsonWord && is_of_word(text[end])) ++end;
  return std::string(text.substr(begin, std::max<std::size_t>(end - begin, 1)));
}

std::string place_words(std::string_view text, std::size_t byte) {
  if (byte == 0 || byte > text.size()) return "the text ends too early; restore it from a copy";
  const std::size_t at = byte - 1;
  const std::string_view before = text.substr(0, at);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t line_begin = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  const std::string word = word_at(text, at);
  std::string sentence = "line " + std::to_string(line) + ", column " + std::to_string(at - line_begin + 1) +
                         ": \"" + word + "\" is not allowed there in JSON";
  for (const char* number : {"Infinity", "-Infinity", "NaN", "nan", "inf", "-inf"})
    if (word == number) sentence += "; write a finite number, or null for an unknown one";
  return sentence;
}

/// Returns the message without the name and number that the library prepends.
std::string plain(const std::string& message) {
  const std::size_t end = message.starts_with('[') ? message.find("] ") : std::string::npos;
  return end == std::string::npos ? message : message.substr(end + 2);
}

/// Describes an error in a JSON text for a person: line and column of a syntax error, a number that is too
/// large, a member that is missing, or what a value was expected to be. `error` is the exception of
/// nlohmann::json for the text.
std::string json_problem(const std::exception& error, std::string_view text) {
  if (const auto* no_json = dynamic_cast<const nlohmann::json::parse_error*>(&error))
    return place_words(text, no_json->byte);
  const auto* beyond = dynamic_cast<const nlohmann::json::out_of_range*>(&error);
  const std::string message = plain(error.what());
  if (beyond && beyond->id == kNumberOverflow) {
    const std::size_t quote = message.find('\'');
    const std::string number = quote == std::string::npos
                                   ? std::string("a number")
                                   : message.substr(quote + 1, message.rfind('\'') - quote - 1);
    return number +
           " is larger than the largest number that can be stored; write a finite one, or null for an "
           "unknown one";
  }
  if (beyond && beyond->id == kMissingMember) return message + "; export the cases again";
  return message;
}

/// `number` is the position in the list, from 1, for messages.
Case case_number(std::int64_t number, const Json& json, const std::vector<Feature>& features) try {
  return case_from(json, features);
} catch (const nlohmann::json::exception& error) {
  throw Error(ErrorCode::input, "case number " + std::to_string(number) + " of the list",
              json_problem(error, ""));
}

void check_schema(const Json& json) {
  const std::string schema = json.is_object() ? json.value("schema", "") : "";
  if (schema != kSchema)
    throw Error(ErrorCode::input, "schema",
                "is \"" + schema + "\", \"" + kSchema +
                    "\" was expected; check that this is an export of a case base");
}

}  // namespace

nlohmann::ordered_json to_json(const CaseBase& base, const Case& c) {
  FieldWriter<Json> writer;
  fields(writer, c);
  writer("features", feature_values(base, c));
  return writer.json();
}

std::string to_cases_json(const CaseBase& base) {
  Json json = {{"schema", kSchema},
               {"near_similarity", number_or_null(base.metric().near_similarity)},
               {"model_identity", base.model_identity()},
               {"robot", base.robot().name},
               {"axes", base.robot().axes},
               {"features", fields_to_json<Json>(base.metric().features)}};
  json["cases"] = Json::array();
  for (const Case& c : base.cases()) json["cases"].push_back(to_json(base, c));
  return json.dump(1) + "\n";
}

CaseBase from_cases_json(const std::string& text, const std::string& where) try {
  const Json json = Json::parse(text);
  check_schema(json);
  Metric metric;
  FieldReader<Json> reader(json, where);
  reader.finite("near_similarity", metric.near_similarity);
  reader("features", metric.features);
  std::vector<Case> cases;
  for (const Json& c : json.at("cases"))
    cases.push_back(case_number(std::ssize(cases) + 1, c, metric.features));
  CaseBase base(std::move(metric), std::move(cases));
  base.belong_to(json.at("model_identity").get<std::string>());
  base.describe_robot({json.at("robot").get<std::string>(), json.at("axes").get<std::string>()});
  return base;
} catch (const nlohmann::json::exception& error) {
  throw Error(ErrorCode::input, where, "is not an export of a case base: " + json_problem(error, text));
} catch (const Error& error) {
  throw Error(ErrorCode::input, where, std::string("is not an export of a case base: ") + error.what());
}

}  // namespace faultline
