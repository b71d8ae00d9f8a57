// SPDX-License-Identifier: MIT
#include "formats/provenance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "lib/core/hash.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kProvenanceSchema = "faultline/provenance/1";
constexpr std::size_t kMostText = 300;  // characters of a message that are repeated
constexpr std::size_t kMostIssues = 8;  // one per code and channel

/// Codes of warnings about lost values in rows that were kept, about omitted signals, and about earlier
/// losses.
constexpr std::array kLostValues{"not_a_number",  "value_implausible", "ragged_row",     "source_damaged",
                                 "joint_missing", "array_length",      "signal_left_out"};

bool is_loss(const Issue& issue) {
  const auto is_code = [&](const char* code) { return issue.code == code; };
  return issue.severity == Severity::severe || issue.rows_dropped > 0 ||
         (issue.severity == Severity::warning &&
          std::any_of(kLostValues.begin(), kLostValues.end(), is_code));
}

Json loss_json(Issue issue) {
  issue.channel = shortened(issue.channel, kLongestName);
  issue.message = shortened(issue.message, kMostText);
  return issue_json(issue);
}

/// Returns a text, shortened, as another program may have written it.
std::string text_at(const nlohmann::json& json, const char* key) {
  return shortened(json.at(key).get_ref<const std::string&>(), kMostText);
}

}  // namespace

std::string provenance_of(const LogSource& source) {
  Json losses = Json::array();
  for (const Issue& issue : source.issues().all())
    if (is_loss(issue) && losses.size() < kMostIssues) losses.push_back(loss_json(issue));
  if (losses.empty()) return "";
  const LogIdentity& log = source.identity();
  const Json json{{"schema", kProvenanceSchema},
                  {"source", std::filesystem::path(log.path).filename().string()},
                  {"sha256", log.sha256.empty() ? sha256_of_file(log.path) : log.sha256},
                  {"rows_read", log.rows_read},
                  {"rows_left_out", source.issues().rows_dropped()},
                  {"losses", losses}};
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

Issue issue_from_provenance(std::string_view text) try {
  const auto json = nlohmann::json::parse(text);
  const nlohmann::json& losses = json.at("losses");
  const auto is_severe = [](const nlohmann::json& loss) {
    return loss.at("severity") == to_string(Severity::severe);
  };
  const bool severe = std::any_of(losses.begin(), losses.end(), is_severe);
  const std::string message = fmt::format(
      "the log was converted from {} (SHA-256 {}), of which {} of {} rows were left out: {}",
      text_at(json, "source"), text_at(json, "sha256"), json.at("rows_left_out").get<std::int64_t>(),
      json.at("rows_read").get<std::int64_t>(), text_at(losses.at(0), "message"));
  return make_issue("source_damaged", severe ? Severity::severe : Severity::warning, message);
} catch (const Json::exception&) {
  return make_issue("provenance_damaged", Severity::severe,
                    "the log was converted from a damaged log, but its description of the damage cannot be "
                    "read");
}

}  // namespace faultline
