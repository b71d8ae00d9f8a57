// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "formats/arrays/array_file.hpp"
#include "formats/arrays/stored_arrays.hpp"
#include "formats/known_formats.hpp"
#include "lib/core/error.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

// Types of elements, and classes of matrices.
constexpr std::uint32_t kMatrix = 14, kCompressed = 15;
constexpr std::uint32_t kCell = 1, kStruct = 2, kChar = 4, kFirstNumeric = 6, kLastNumeric = 15;
constexpr std::uint32_t kComplex = 0x0800;

constexpr std::size_t kMatHeaderBytes = 128;
constexpr std::int64_t kTagBytes = 8, kSmallData = 4;
constexpr std::size_t kMostDimensions = 32;
constexpr std::int64_t kLongestText = 1 << 24;
constexpr std::int64_t kMat5MostElements = std::int64_t{1} << 48;
constexpr int kMat5Deepest = 16;
constexpr std::size_t kMostArrays = 1 << 14;

/// Returns the type of an element; nullopt for one that is no number.
std::optional<ElementType> number_of(std::uint32_t type) {
  static const std::map<std::uint32_t, ElementType> known{
      {1, ElementType::i1},  {2, ElementType::u1}, {3, ElementType::i2}, {4, ElementType::u2},
      {5, ElementType::i4},  {6, ElementType::u4}, {7, ElementType::f4}, {9, ElementType::f8},
      {12, ElementType::i8}, {13, ElementType::u8}};
  const auto found = known.find(type);
  return found == known.end() ? std::nullopt : std::optional(found->second);
}

/// Returns the name of an array in structures of MATLAB: for the output of Simulink and for time series the
/// name of the signal, "q" for "q.signals.values" and "q.Data".
std::string matlab_name(const std::string& path) {
  for (const char* ending : {".signals.values", ".Data", ".data"})
    if (path.ends_with(ending)) return path.substr(0, path.size() - std::strlen(ending));
  return path;
}

/// An element: the positions of its data and of the next element.
struct MatElement {
  std::uint32_t type = 0;
  std::int64_t bytes = 0, data = 0, next = 0;
};

/// The part of a matrix before its data.
struct MatrixHead {
  std::uint32_t kind = 0, flags = 0;
  std::vector<std::int64_t> shape;
  std::string name;
  std::int64_t data = 0;  ///< position of its data
};

std::int64_t count_of(const std::vector<std::int64_t>& shape) {
  std::int64_t count = 1;
  for (const std::int64_t size : shape)
    count = size > 0 && count > kMat5MostElements / size ? kMat5MostElements : count * size;
  return count;
}

/// Parses the matrices of one content.
class MatrixParser {
 public:
  MatrixParser(const RandomFile& file, StoredList& list, std::size_t content, bool swapped)
      : stream_(file, list.contents[content]), list_(list), content_(content), swapped_(swapped) {}

  std::optional<MatElement> element_at(std::int64_t at) {
    std::array<std::uint32_t, 2> tag{};
    if (stream_.read(at, reinterpret_cast<char*>(tag.data()), kTagBytes) <
        static_cast<std::size_t>(kTagBytes))
      return std::nullopt;
    const std::uint32_t type = number(tag[0]);
    if (type >> 16U) return MatElement{type & 0xffffU, type >> 16U, at + kSmallData, at + kTagBytes};
    const std::int64_t bytes = number(tag[1]);
    const std::int64_t padded = type == kCompressed ? bytes : (bytes + kTagBytes - 1) / kTagBytes * kTagBytes;
    return MatElement{type, bytes, at + kTagBytes, at + kTagBytes + padded};
  }

  /// Reads the matrix in the element; false when it is damaged.
  bool read_matrix(const MatElement& element, const std::string& path, int depth) {
    if (element.type != kMatrix) return false;
    if (element.bytes == 0) return true;
    const auto head = head_of(element);
    if (!head || depth > kMat5Deepest) return false;
    const std::string name = path.empty() ? head->name : path;
    if (head->kind == kStruct) return read_struct(*head, name, depth);
    if (head->kind == kChar) return read_text(*head, name, depth);
    if (head->kind >= kFirstNumeric && head->kind <= kLastNumeric && !(head->flags & kComplex))
      return add_array(*head, name);
    if (head->kind != kCell) leave_out(name);
    return true;
  }

 private:
  std::uint32_t number(std::uint32_t value) const { return swapped_ ? __builtin_bswap32(value) : value; }

  std::optional<MatrixHead> head_of(const MatElement& matrix) {
    MatrixHead head;
    const auto flags = element_at(matrix.data);
    if (!flags || flags->bytes < kTagBytes) return std::nullopt;
    const auto words = words_of(*flags, 2);
    const auto sizes = element_at(flags->next);
    if (!sizes || words.size() < 2) return std::nullopt;
    head.kind = words[0] & 0xffU;
    head.flags = words[0];
    for (const std::uint32_t size : words_of(*sizes, kMostDimensions)) head.shape.push_back(size);
    const auto name = element_at(sizes->next);
    if (!name || head.shape.size() < 2) return std::nullopt;
    head.name = text_of(*name);
    head.data = name->next;
    return head;
  }

  std::vector<std::uint32_t> words_of(const MatElement& element, std::size_t most) {
    std::vector<std::uint32_t> words(std::min(most, static_cast<std::size_t>(element.bytes) / 4));
    const std::size_t bytes = words.size() * 4;
    if (stream_.read(element.data, reinterpret_cast<char*>(words.data()), bytes) < bytes) return {};
    for (std::uint32_t& word : words) word = number(word);
    return words;
  }

  std::string text_of(const MatElement& element) {
    std::string text(static_cast<std::size_t>(std::min(element.bytes, most_held())), '\0');
    text.resize(stream_.read(element.data, text.data(), text.size()));
    return text;
  }

  std::int64_t most_held() const { return std::min(kLongestText, most_bytes(list_.contents[content_])); }

  bool add_array(const MatrixHead& head, const std::string& name) {
    const auto data = element_at(head.data);
    const auto type = data ? number_of(data->type) : std::nullopt;
    if (!type || list_.arrays.size() >= kMostArrays) return false;
    const auto item = static_cast<std::int64_t>(size_of(*type));
    if (count_of(head.shape) > data->bytes / item) return false;
    StoredArray stored;
    stored.array.name = matlab_name(name);
    stored.array.shape = head.shape;
    stored.content = content_;
    stored.begin = data->data;
    stored.strides = packed_strides(head.shape, item, true);
    stored.type = *type;
    stored.swapped = swapped_;
    list_.arrays.push_back(std::move(stored));
    return true;
  }

  void leave_out(const std::string& name) {
    list_.issues.add(
        make_issue("array_left_out", Severity::note,
                   "\"" + shortened(name, kLongestName) +
                       "\" is complex, sparse or an object, and was left out; save its numbers in a "
                       "structure or a matrix",
                   name));
  }

  /// Reads a text of one byte per character, or of two of which the second is 0.
  bool read_text(const MatrixHead& head, const std::string& name, int depth) {
    const auto data = element_at(head.data);
    if (!data) return false;
    std::string text = text_of(*data);
    std::erase(text, '\0');
    if (depth == 0 && name == kNotesName) list_.notes = text + " ";
    if (name.ends_with(".label")) label_ = text;
    return true;
  }

  bool read_struct(const MatrixHead& head, const std::string& name, int depth) {
    const auto length = element_at(head.data);
    const auto words = length ? words_of(*length, 1) : std::vector<std::uint32_t>{};
    const auto names = words.empty() || words[0] == 0 ? std::nullopt : element_at(length->next);
    if (!names) return false;
    const std::string all = text_of(*names);
    std::vector<std::string> fields;
    for (std::size_t at = 0; at + words[0] <= all.size(); at += words[0])
      fields.emplace_back(all.substr(at, words[0]).c_str());
    std::int64_t at = names->next;
    const std::int64_t count = count_of(head.shape);
    for (std::int64_t i = 0; i < count && !fields.empty(); ++i) {
      const std::string part = count > 1 ? name + "(" + std::to_string(i + 1) + ")" : name;
      if (!read_fields(fields, part, depth, at)) return false;
    }
    return true;
  }

  bool read_fields(const std::vector<std::string>& fields, const std::string& name, int depth,
                   std::int64_t& at) {
    const std::size_t before = list_.arrays.size();
    label_.clear();
    for (const std::string& field : fields) {
      const auto element = element_at(at);
      if (!element || !read_matrix(*element, name + "." + field, depth + 1)) return false;
      at = element->next;
    }
    // In structures of Simulink the label names the signal.
    const bool has_values = std::find(fields.begin(), fields.end(), "values") != fields.end();
    if (has_values && !label_.empty() && list_.arrays.size() > before)
      list_.arrays[before].array.name = name.substr(0, name.rfind('.')) + "." + label_;
    label_.clear();
    return true;
  }

  ContentStream stream_;
  StoredList& list_;
  std::size_t content_;
  bool swapped_;
  std::string label_;  ///< of the signal that is being read
};

void report_damaged(StoredList& list, std::int64_t at, bool cut) {
  list.issues.add(make_issue(
      cut ? "file_truncated" : "array_damaged", Severity::severe,
      cut ? fmt::format("the file ends inside the variable at byte {}", at)
          : fmt::format("the variable at byte {} is damaged; all or part of it was left out", at)));
}

/// Reads the variables one after another.
void read_variables(const RandomFile& file, bool swapped, StoredList& list) {
  MatrixParser plain(file, list, 0, swapped);
  for (std::int64_t at = kMatHeaderBytes; at < file.size();) {
    const auto element = plain.element_at(at);
    if (!element) return report_damaged(list, at, true);
    const bool cut = element->next > file.size();
    bool good = false;
    if (element->type == kCompressed) {
      const std::int64_t bytes = std::min(element->bytes, file.size() - element->data);
      list.contents.push_back({"", element->data, bytes, Packing::zlib, std::nullopt, std::nullopt});
      MatrixParser packed(file, list, list.contents.size() - 1, swapped);
      const auto matrix = packed.element_at(0);
      if (matrix) list.contents.back().unpacked = matrix->next;
      good = matrix && packed.read_matrix(*matrix, "", 0);
    } else {
      good = plain.read_matrix(*element, "", 0);
    }
    if (!good || cut) report_damaged(list, at, cut);
    at = element->next;
  }
}

/// Opens the matrices of numbers of a MATLAB file of version 5 (6, 7); those in structures are named by their
/// path, as name.field. Throws Error(input) when it is cut inside its header.
std::unique_ptr<ArrayFile> open_mat5_arrays(const std::string& path) {
  auto file = std::make_unique<RandomFile>(path);
  const std::string header = file->text(0, kMatHeaderBytes);
  if (header.size() < kMatHeaderBytes)
    throw Error(ErrorCode::input, path, "is cut inside its header; nothing can be read from it");
  const bool big_endian = header.ends_with("MI");
  StoredList list;
  list.contents.push_back({"", 0, file->size(), Packing::plain, std::nullopt, std::nullopt});
  read_variables(*file, big_endian == (std::endian::native == std::endian::little), list);
  return std::make_unique<StoredArrays>(std::move(file), std::move(list));
}

constexpr std::string_view kFirstWords = "MATLAB 5.0 MAT-file", kFirstWords73 = "MATLAB 7.3 MAT-file";
constexpr std::size_t kVersionAt = 124;

/// Converts a path in HDF5 to the name that MATLAB shows.
std::string name_of_path(const std::string& path) {
  std::string name = path;
  std::replace(name.begin(), name.end(), '/', '.');
  return matlab_name(name);
}

std::unique_ptr<ArrayFile> open_mat73_arrays(const std::string& path) {
  return open_hdf5_arrays(path, name_of_path);
}

}  // namespace

bool looks_like_matlab(std::string_view head) {
  const std::string_view version = head.substr(std::min(kVersionAt, head.size()), 4);
  const std::string_view little("\0\x01IM", 4), big("\x01\0MI", 4);
  return version == little || version == big || head.starts_with(kFirstWords) ||
         head.starts_with(kFirstWords73);
}

std::unique_ptr<RawReader> open_matlab(std::unique_ptr<ByteSource> bytes) {
  const bool hdf5 = looks_like_hdf5(bytes->head()) || bytes->head().starts_with(kFirstWords73);
  return read_arrays(std::move(bytes), "matlab", hdf5 ? open_mat73_arrays : open_mat5_arrays);
}

}  // namespace faultline
