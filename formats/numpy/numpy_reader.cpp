// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "formats/arrays/array_file.hpp"
#include "formats/arrays/stored_arrays.hpp"
#include "formats/known_formats.hpp"
#include "formats/numpy/npy_header.hpp"
#include "lib/core/error.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr std::uint32_t kLocal = 0x04034b50, kCentral = 0x02014b50, kEnd = 0x06054b50, kEnd64 = 0x06064b50;
constexpr std::size_t kLocalBytes = 30, kCentralBytes = 46, kEndBytes = 22, kEnd64Bytes = 56,
                      kLocatorBytes = 20;
constexpr std::size_t kLongestComment = 1 << 16;
constexpr std::size_t kMostDirectory = 1 << 24;
constexpr std::size_t kMostMembers = 1 << 14;
constexpr std::uint32_t kMembersIn64 = 0xffffffff;  ///< the number is in the extra field
constexpr std::uint16_t kExtra64 = 1;
constexpr std::uint16_t kStored = 0, kDeflated = 8;
constexpr std::uint16_t kEncrypted = 1, kSizesBehind = 8;  ///< flags

template <typename Number>
Number number_at(const std::string& bytes, std::size_t at) {
  Number number = 0;
  if (at + sizeof number <= bytes.size()) std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

/// The content of both headers of a member.
struct ZipMember {
  std::string name;
  std::uint16_t flags = 0, method = 0;
  std::uint32_t crc = 0;
  std::uint64_t packed = 0, unpacked = 0, local = 0;
};

/// Reads numbers that are too large for the header.
void read_extra(const std::string& extra, ZipMember& member) {
  for (std::size_t at = 0; at + 4 <= extra.size();) {
    const auto id = number_at<std::uint16_t>(extra, at), size = number_at<std::uint16_t>(extra, at + 2);
    at += 4;
    if (id == kExtra64) {
      std::size_t next = at;
      for (std::uint64_t* number : {&member.unpacked, &member.packed, &member.local})
        if (*number == kMembersIn64) *number = number_at<std::uint64_t>(extra, next), next += 8;
    }
    at += size;
  }
}

/// Reads a header that ends at `end`, before its name and extra field. Both headers have the same fields from
/// `flags` on. Returns the position after all; 0 if `bytes` end before.
std::size_t read_header(const std::string& bytes, std::size_t flags, std::size_t end, ZipMember& member) {
  member.flags = number_at<std::uint16_t>(bytes, flags);
  member.method = number_at<std::uint16_t>(bytes, flags + 2);
  member.crc = number_at<std::uint32_t>(bytes, flags + 8);
  member.packed = number_at<std::uint32_t>(bytes, flags + 12);
  member.unpacked = number_at<std::uint32_t>(bytes, flags + 16);
  const std::size_t name = number_at<std::uint16_t>(bytes, flags + 20),
                    extra = number_at<std::uint16_t>(bytes, flags + 22);
  if (end + name + extra > bytes.size()) return 0;
  member.name = bytes.substr(end, name);
  read_extra(bytes.substr(end + name, extra), member);
  return end + name + extra;
}

struct Directory {
  std::uint64_t at = 0, bytes = 0, members = 0;
};

std::optional<Directory> find_directory(const RandomFile& file) {
  const std::int64_t tail_at =
      std::max<std::int64_t>(0, file.size() - static_cast<std::int64_t>(kEndBytes + kLongestComment));
  const std::string tail = file.text(tail_at, kEndBytes + kLongestComment);
  for (std::size_t i = tail.size() < kEndBytes ? 0 : tail.size() - kEndBytes + 1; i-- > 0;) {
    if (number_at<std::uint32_t>(tail, i) != kEnd) continue;
    Directory found{number_at<std::uint32_t>(tail, i + 16), number_at<std::uint32_t>(tail, i + 12),
                    number_at<std::uint16_t>(tail, i + 10)};
    if (found.at != kMembersIn64 && found.bytes != kMembersIn64) return found;
    if (i < kLocatorBytes) return std::nullopt;
    const auto end64 = number_at<std::uint64_t>(tail, i - kLocatorBytes + 8);
    const std::string end =
        file.text(static_cast<std::int64_t>(std::min<std::uint64_t>(end64, file.size())), kEnd64Bytes);
    if (number_at<std::uint32_t>(end, 0) != kEnd64) return std::nullopt;
    return Directory{number_at<std::uint64_t>(end, 48), number_at<std::uint64_t>(end, 40),
                     number_at<std::uint64_t>(end, 32)};
  }
  return std::nullopt;
}

/// Returns nullopt when the directory is damaged.
std::optional<std::vector<ZipMember>> read_directory(const RandomFile& file) {
  const auto directory = find_directory(file);
  const auto size = static_cast<std::uint64_t>(file.size());
  if (!directory || directory->at > size || directory->bytes > size - directory->at ||
      directory->bytes > kMostDirectory)
    return std::nullopt;
  const std::string bytes =
      file.text(static_cast<std::int64_t>(directory->at), static_cast<std::size_t>(directory->bytes));
  std::vector<ZipMember> members;
  for (std::size_t at = 0; at + kCentralBytes <= bytes.size();) {
    if (number_at<std::uint32_t>(bytes, at) != kCentral) return std::nullopt;
    ZipMember member;
    member.local = number_at<std::uint32_t>(bytes, at + 42);
    const std::size_t end = read_header(bytes, at + 8, at + kCentralBytes, member);
    if (end == 0) return std::nullopt;
    members.push_back(member);
    at = end + number_at<std::uint16_t>(bytes, at + 32);  // its comment
  }
  if (members.size() != directory->members || members.size() > kMostMembers) return std::nullopt;
  return members;
}

/// Reads the local header at `at`; returns its bytes, 0 when there is none.
std::size_t local_header(const RandomFile& file, std::uint64_t at, ZipMember& member) {
  if (at > static_cast<std::uint64_t>(file.size())) return 0;
  std::string header = file.text(static_cast<std::int64_t>(at), kLocalBytes);
  if (header.size() < kLocalBytes || number_at<std::uint32_t>(header, 0) != kLocal) return 0;
  const std::size_t more = number_at<std::uint16_t>(header, 26) + number_at<std::uint16_t>(header, 28);
  header += file.text(static_cast<std::int64_t>(at + kLocalBytes), more);
  member.local = at;
  return read_header(header, 6, kLocalBytes, member);
}

/// The members of a .zip file according to its directory. If that is damaged or missing, they are searched
/// from the front, with an issue. Members that cannot be read are omitted and reported.
class MemberList {
 public:
  MemberList(const RandomFile& file, Issues& issues) : file_(file), issues_(issues) {}

  std::vector<StoredContent> run() {
    if (const auto members = read_directory(file_)) {
      for (const ZipMember& member : *members) add_listed(member);
    } else {
      issues_.add(
          make_issue("file_truncated", Severity::severe,
                     "the directory at the end of the file is damaged or missing; the file was searched "
                     "for arrays from its beginning"));
      scan();
    }
    return std::move(contents_);
  }

 private:
  void add_listed(const ZipMember& member) {
    ZipMember local;
    const std::size_t header = local_header(file_, member.local, local);
    if (header == 0) return leave_out(member.name, "its header is damaged");
    add(member, member.local + header);
  }

  void leave_out(const std::string& name, const char* why) {
    issues_.add(make_issue("array_damaged", Severity::severe,
                           fmt::format("\"{}\" was left out: {}", shortened(name, kLongestName), why), name));
  }

  void add(const ZipMember& member, std::uint64_t at) {
    if (!names_.insert(member.name).second)
      return leave_out(member.name, "the file has two arrays of this name");
    if (member.flags & kEncrypted) return leave_out(member.name, "it is encrypted");
    if (member.method != kStored && member.method != kDeflated)
      return leave_out(member.name, "its compression is neither none nor deflate; save it again with numpy");
    const std::uint64_t left =
        static_cast<std::uint64_t>(file_.size()) - std::min<std::uint64_t>(at, file_.size());
    StoredContent content;
    content.name = member.name;
    content.offset = static_cast<std::int64_t>(at);
    content.bytes = static_cast<std::int64_t>(std::min(left, member.packed));
    content.packing = member.method == kStored ? Packing::plain : Packing::deflate;
    if (member.unpacked <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
      content.unpacked = static_cast<std::int64_t>(member.unpacked);
    if (member.packed <= left) content.crc = member.crc;
    contents_.push_back(content);
  }

  /// Finds members by local headers. A member that was being written has no size yet: it takes the rest.
  void scan() {
    std::uint64_t at = 0;
    while (contents_.size() < kMostMembers) {
      ZipMember member;
      const std::size_t header = local_header(file_, at, member);
      if (header == 0) return;
      at += header;
      const bool unknown = (member.flags & kSizesBehind) || (member.packed == 0 && member.unpacked == 0);
      if (unknown) return add_open(member, at);
      add(member, at);
      if (member.packed > static_cast<std::uint64_t>(file_.size())) return;
      at += member.packed;
    }
  }

  void add_open(ZipMember member, std::uint64_t at) {
    const std::size_t before = contents_.size();
    member.packed = static_cast<std::uint64_t>(file_.size()) - std::min<std::uint64_t>(at, file_.size());
    add(member, at);
    if (contents_.size() == before) return;
    contents_.back().crc.reset();
    contents_.back().unpacked.reset();
  }

  const RandomFile& file_;
  Issues& issues_;
  std::vector<StoredContent> contents_;
  std::set<std::string> names_;
};

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
  if (has("xl/"))
    return "is an Excel workbook; save the sheet with the log as CSV in UTF-8, or convert it: libreoffice "
           "--headless --convert-to csv run.xlsx";
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
  list.contents = MemberList(*file, list.issues).run();
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
