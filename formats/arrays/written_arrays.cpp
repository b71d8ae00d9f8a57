// SPDX-License-Identifier: MIT
#include "formats/arrays/written_arrays.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "formats/log_writer.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/output_place.hpp"
#include "lib/log/log_channels.hpp"

namespace faultline {
namespace {

constexpr std::size_t kLongestPart = 40;  ///< of a channel's name; MATLAB allows names of 63

/// Returns the columns of a log, one list per array.
std::vector<std::vector<const std::vector<double>*>> columns_of(const Log& log) {
  std::vector<std::vector<const std::vector<double>*>> all{{&log.time}};
  for (const Quantity quantity : kJointQuantities) {
    const JointSignals& signals = signals_of(log, quantity);
    if (signals.empty()) continue;
    all.emplace_back();
    for (const std::vector<double>& signal : signals) all.back().push_back(&signal);
  }
  for (const ExtraChannel& extra : log.extra) all.push_back({&extra.values});
  return all;
}

std::string stem_of(Quantity quantity) {
  const std::string name = to_string(Channel{quantity, 1});
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
  for (std::size_t i = channels.size() - segment.extra.size(); i < channels.size(); ++i) {
    arrays_.push_back({name_of_extra(channels[i].name), channels[i].unit, 1, true, {}});
    notes_.extra.push_back({arrays_.back().name, channels[i].name, channels[i].unit});
  }
}

void WrittenArrays::add(const Log& segment, int begin, int end) {
  if (arrays_.empty()) name_arrays(segment);
  const auto columns = columns_of(segment);
  const auto alike = [](const WrittenArray& array, const auto& have) {
    return array.width == static_cast<int>(have.size());
  };
  if (!std::equal(arrays_.begin(), arrays_.end(), columns.begin(), columns.end(), alike))
    throw Error(ErrorCode::internal, path_, "segments of one log must have the same channels");
  for (std::size_t i = 0; i < arrays_.size(); ++i)
    for (int row = begin; row < end; ++row)
      for (const std::vector<double>* column : columns[i])
        arrays_[i].values.push_back((*column)[static_cast<std::size_t>(row)]);
  rows_ += end - begin;
}

void WrittenArrays::clear() {
  for (WrittenArray& array : arrays_) array.values.clear();
  rows_ = 0;
}

std::string WrittenArrays::notes() const {
  return notes_.extra.empty() && notes_.provenance.empty() ? "" : notes_text(notes_);
}

void refuse_pipe_for(const std::string& path, const std::string& format) {
  if (output_place(path).special)
    throw Error(ErrorCode::output, path,
                "is a pipe or a device, but " + format +
                    " can be written to a file only; name a file, or write .csv there");
}

}  // namespace faultline
