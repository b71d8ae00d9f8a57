// SPDX-License-Identifier: MIT
#include "formats/arrays/written_arrays.hpp"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <utility>

#include "formats/log_writer.hpp"
#include "lib/core/error.hpp"
#include "lib/log/log.hpp"

namespace faultline {
namespace {

using NotesJson = nlohmann::ordered_json;

constexpr const char* kNotesSchema = "faultline/arrays/1";
constexpr std::size_t kLongestPart = 40;  ///< of a channel's name; MATLAB allows names of 63

std::string stem_of(Quantity quantity) {
  const std::string name = to_string(Channel{quantity, 1_joint});
  return name.substr(0, name.size() - 1);
}

}  // namespace

WrittenArrays::WrittenArrays(std::string path, std::string prefix)
    : path_(std::move(path)), prefix_(std::move(prefix)) {}

std::string WrittenArrays::name_of_extra(const std::string& channel) const {
  std::string part = channel.substr(0, kLongestPart);
  std::replace_if(
      part.begin(), part.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  const auto taken = [&](const std::string& name) {
    return std::any_of(arrays_.begin(), arrays_.end(),
                       [&](const WrittenArray& array) { return array.name == name; });
  };
  std::string name = prefix_ + part;
  for (int i = 2; taken(name); ++i) name = prefix_ + part + "_" + std::to_string(i);
  return name;
}

void WrittenArrays::name_arrays(const Log& segment) {
  arrays_.push_back({"t", "s", 1, true, {}});
  for (const Quantity quantity : kJointQuantities)
    if (const auto width = static_cast<int>(signals_of(segment, quantity).size()); width > 0)
      arrays_.push_back({stem_of(quantity), "", width, false, {}});
  const std::vector<WrittenChannel> channels = channels_of(segment);
  channels_ = channels.size();
  for (std::size_t i = channels_ - segment.extra.size(); i < channels_; ++i) {
    arrays_.push_back({name_of_extra(channels[i].name), channels[i].unit, 1, true, {}});
    notes_.extra.push_back({arrays_.back().name, channels[i].name, channels[i].unit});
  }
}

void WrittenArrays::add(const Log& segment, int begin, int end) {
  if (arrays_.empty()) name_arrays(segment);
  const std::vector<WrittenChannel> channels = channels_of(segment);
  if (channels.size() != channels_)
    throw Error(ErrorCode::internal, path_, "segments of one log must have the same channels");
  auto channel = channels.begin();
  for (WrittenArray& array : arrays_) {
    for (int row = begin; row < end; ++row)
      for (int c = 0; c < array.width; ++c)
        array.values.push_back((*channel[c].values)[static_cast<std::size_t>(row)]);
    channel += array.width;
  }
  rows_ += end - begin;
}

void WrittenArrays::clear() {
  for (WrittenArray& array : arrays_) array.values.clear();
  rows_ = 0;
}

std::string WrittenArrays::notes() const {
  return notes_.extra.empty() && notes_.provenance.empty() ? "" : notes_text(notes_);
}

std::string notes_text(const ArrayNotes& notes) {
  NotesJson extra = NotesJson::array();
  for (const NotedChannel& channel : notes.extra)
    extra.push_back({{"array", channel.array}, {"name", channel.name}, {"unit", channel.unit}});
  NotesJson json{{"schema", kNotesSchema}, {"extra", extra}};
  if (!notes.provenance.empty()) json["provenance"] = notes.provenance;
  return json.dump(-1, ' ', true, NotesJson::error_handler_t::replace);
}

std::optional<ArrayNotes> read_notes(std::string_view text) try {
  const auto json = nlohmann::json::parse(text);
  if (json.at("schema") != kNotesSchema) return std::nullopt;
  ArrayNotes notes;
  for (const auto& channel : json.at("extra"))
    notes.extra.push_back({channel.at("array"), channel.at("name"), channel.at("unit")});
  if (json.contains("provenance")) notes.provenance = json.at("provenance");
  return notes;
} catch (const nlohmann::json::exception&) {
  return std::nullopt;
}

}  // namespace faultline
