// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "formats/arrays/array_notes.hpp"
#include "formats/arrays/array_reader.hpp"
#include "formats/arrays/stored_arrays.hpp"
#include "formats/numpy/npy_header.hpp"
#include "formats/numpy/numpy_format.hpp"
#include "formats/numpy/zip_members.hpp"
#include "lib/core/error.hpp"
#include "lib/core/make_issue.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr std::string_view kNpyEnding = ".npy";
constexpr std::size_t kLongestNotes = 1 << 24;
constexpr std::size_t kNamedMembers = 8;

std::unique_ptr<ArrayFile> open_npy_file(const std::string& path) {
  auto file = std::make_unique<RandomFile>(path);
  StoredList list;
  list.contents.push_back({"", 0, file->size(), Packing::plain, std::nullopt, std::nullopt});
  ContentStream stream(*file, list.contents[0]);
  auto array = read_npy_header(stream, "", list.issues);
  if (!array)
    throw Error(
        ErrorCode::input, path,
        "has a damaged header, or is cut inside it; nothing can be read from it. Save it again with numpy");
  list.arrays = std::move(array->arrays);
  if (!list.arrays.empty() && file->size() > array->bytes)
    list.issues.add(
        make_issue("trailing_bytes", Severity::warning,
                   fmt::format("{} bytes after the array were ignored", file->size() - array->bytes)));
  return std::make_unique<StoredArrays>(std::move(file), std::move(list));
}

void add_member(const RandomFile& file, std::size_t content, StoredList& list) {
  const StoredContent& member = list.contents[content];
  const std::string name = member.name.substr(0, member.name.size() - kNpyEnding.size());
  ContentStream stream(file, member);
  auto array = read_npy_header(stream, name, list.issues);
  if (!array) {
    list.issues.add(make_issue(
        "array_damaged", Severity::severe,
        fmt::format("\"{}\" was left out: its header is damaged", shortened(name, kLongestName)), name));
    return;
  }
  for (StoredArray& stored : array->arrays) {
    stored.content = content;
    list.arrays.push_back(std::move(stored));
  }
}

/// Returns the notes; a blank if they are empty, so that they count as damaged (no JSON).
std::string read_text(const RandomFile& file, const StoredContent& member) {
  std::string text(std::min<std::size_t>(kLongestNotes, static_cast<std::size_t>(most_bytes(member))), '\0');
  ContentStream stream(file, member);
  text.resize(stream.read(0, text.data(), text.size()));
  return text.empty() ? " " : text;
}

/// Returns what a ZIP archive without arrays of NumPy is, and what to do.
std::string other_archive(const std::vector<StoredContent>& members) {
  const auto has = [&](std::string_view begin) {
    return std::any_of(members.begin(), members.end(),
                       [&](const StoredContent& member) { return member.name.starts_with(begin); });
  };
  if (has("xl/")) return "is an Excel workbook; save the sheet with the log as CSV in UTF-8";
  if (has("content.xml")) return "is an OpenDocument file; save the sheet with the log as CSV in UTF-8";
  if (has("word/") || has("ppt/")) return "is an Office document, not a log; export the log itself as CSV";
  std::string names;
  std::size_t files = 0;
  for (const StoredContent& member : members) {
    if (member.name.ends_with('/')) continue;
    if (++files <= kNamedMembers) names += (files > 1 ? ", " : "") + shortened(member.name, kLongestName);
  }
  if (files == 0) return "is an empty ZIP archive";
  if (files > kNamedMembers) names += fmt::format(" and {} more", files - kNamedMembers);
  return "is a ZIP archive without NumPy arrays; it holds " + names +
         ". Unpack it first and give the file that holds the log";
}

std::unique_ptr<ArrayFile> open_npz_file(const std::string& path) {
  auto file = std::make_unique<RandomFile>(path);
  StoredList list;
  list.contents = zip_members(*file, list.issues);
  for (std::size_t i = 0; i < list.contents.size(); ++i) {
    if (list.contents[i].name == kNotesName + std::string(".json"))
      list.notes = read_text(*file, list.contents[i]);
    else if (list.contents[i].name.ends_with(kNpyEnding))
      add_member(*file, i, list);
  }
  const bool any = std::any_of(list.contents.begin(), list.contents.end(),
                               [](const StoredContent& member) { return member.name.ends_with(kNpyEnding); });
  if (!any && list.issues.empty()) throw Error(ErrorCode::input, path, other_archive(list.contents));
  return std::make_unique<StoredArrays>(std::move(file), std::move(list));
}

}  // namespace

bool looks_like_npy(std::string_view head) { return head.starts_with(kNpyMagic); }

bool looks_like_npz(std::string_view head) {
  return head.starts_with("PK\x03\x04") || head.starts_with("PK\x05\x06");
}

std::unique_ptr<RawReader> open_npy(std::unique_ptr<ByteSource> bytes) {
  return read_arrays(std::move(bytes), "npy", open_npy_file);
}

std::unique_ptr<RawReader> open_npz(std::unique_ptr<ByteSource> bytes) {
  return read_arrays(std::move(bytes), "npz", open_npz_file);
}

}  // namespace faultline
