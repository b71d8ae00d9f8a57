// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "formats/arrays/array_file.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "faultline/arrays/1";

}  // namespace

std::string notes_text(const ArrayNotes& notes) {
  Json extra = Json::array();
  for (const NotedChannel& channel : notes.extra)
    extra.push_back({{"array", channel.array}, {"name", channel.name}, {"unit", channel.unit}});
  Json json{{"schema", kSchema}, {"extra", extra}};
  if (!notes.provenance.empty()) json["provenance"] = notes.provenance;
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::optional<ArrayNotes> read_notes(std::string_view text) try {
  const auto json = nlohmann::json::parse(text);
  if (json.at("schema") != kSchema) return std::nullopt;
  ArrayNotes notes;
  for (const auto& channel : json.at("extra"))
    notes.extra.push_back({channel.at("array"), channel.at("name"), channel.at("unit")});
  if (json.contains("provenance")) notes.provenance = json.at("provenance");
  return notes;
} catch (const nlohmann::json::exception&) {
  return std::nullopt;
}

}  // namespace faultline
