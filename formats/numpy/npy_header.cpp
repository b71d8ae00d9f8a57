// SPDX-License-Identifier: MIT
#include "formats/numpy/npy_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "lib/core/issue.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

using NpyJson = nlohmann::json;
using Shape = std::vector<std::int64_t>;

constexpr std::size_t kMagicBytes = 8;  ///< with the version
constexpr std::uint32_t kLongestHeader = 1 << 22;
constexpr std::int64_t kHeaderMostBytes = std::int64_t{1} << 53;
constexpr std::size_t kHeaderMostDimensions = 32;
constexpr std::int64_t kUnicodeBytes = 4;  ///< of a character
constexpr int kLiteralDeepest = 16;

/// Parses a Python literal of dictionaries, lists, tuples, strings, whole numbers, True, False and None;
/// tuples become lists.
class PythonParser {
 public:
  explicit PythonParser(std::string_view text) : text_(text) {}

  /// Returns nullopt for any other literal, or one nested deeper than any header.
  std::optional<NpyJson> run() {
    NpyJson value = read(0);
    return failed_ ? std::nullopt : std::optional(value);
  }

 private:
  NpyJson fail() {
    failed_ = true;
    return {};
  }

  char peek() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  bool take(std::string_view word) {
    peek();
    if (text_.substr(at_, word.size()) != word) return false;
    at_ += word.size();
    return true;
  }

  NpyJson read(int depth) {
    if (depth > kLiteralDeepest) return fail();
    const char c = peek();
    if (c == '{') return read_dictionary(depth);
    if (c == '[') return read_list(depth, ']');
    if (c == '(') return read_list(depth, ')');
    if (c == '\'' || c == '"') return read_string();
    if ((c == 'u' || c == 'b') && at_ + 1 < text_.size() &&
        (text_[at_ + 1] == '\'' || text_[at_ + 1] == '"')) {
      ++at_;
      return read_string();
    }
    if (take("True")) return true;
    if (take("False")) return false;
    if (take("None")) return nullptr;
    return read_number();
  }

  NpyJson read_dictionary(int depth) {
    NpyJson all = NpyJson::object();
    ++at_;
    while (!failed_ && !take("}")) {
      const NpyJson key = read(depth + 1);
      if (!key.is_string() || !take(":")) return fail();
      all[key.get<std::string>()] = read(depth + 1);
      if (!take(",") && peek() != '}') return fail();
    }
    return all;
  }

  NpyJson read_list(int depth, char close) {
    NpyJson all = NpyJson::array();
    ++at_;
    while (!failed_ && !take(std::string_view(&close, 1))) {
      all.push_back(read(depth + 1));
      if (!take(",") && peek() != close) return fail();
    }
    return all;
  }

  NpyJson read_string() {
    const char quote = text_[at_++];
    std::string text;
    for (; at_ < text_.size() && text_[at_] != quote; ++at_) {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
      text += text_[at_];
    }
    if (at_ == text_.size()) return fail();
    ++at_;
    return text;
  }

  NpyJson read_number() {
    std::int64_t value = 0;
    const std::size_t before = at_;
    for (; at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])); ++at_) {
      if (value > (std::numeric_limits<std::int64_t>::max() - 9) / 10) return fail();
      value = 10 * value + (text_[at_] - '0');
    }
    if (at_ == before) return fail();
    take("L");  // of Python 2
    return value;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

/// A type of numpy, such as "<f8"; `number` is empty for elements that no log has.
struct NumpyType {
  std::optional<ElementType> number;
  std::int64_t bytes = 0;
  bool swapped = false;
  bool moment = false;
  std::string unit;
};

std::optional<ElementType> number_of(const std::string& kind) {
  static const std::map<std::string, ElementType> known{
      {"f4", ElementType::f4}, {"f8", ElementType::f8}, {"i1", ElementType::i1}, {"i2", ElementType::i2},
      {"i4", ElementType::i4}, {"i8", ElementType::i8}, {"u1", ElementType::u1}, {"u2", ElementType::u2},
      {"u4", ElementType::u4}, {"u8", ElementType::u8}, {"b1", ElementType::u1}, {"M8", ElementType::i8},
      {"m8", ElementType::i8}};
  const auto found = known.find(kind);
  return found == known.end() ? std::nullopt : std::optional(found->second);
}

std::optional<NumpyType> type_of(const std::string& text) {
  if (text.size() < 3 || std::strchr("<>|=", text[0]) == nullptr) return std::nullopt;
  NumpyType type;
  const std::size_t bracket = std::min(text.find('['), text.size());
  const std::string kind = text.substr(1, bracket - 1), size = kind.substr(1);
  if (size.empty() || size.size() > 9 || size.find_first_not_of("0123456789") != std::string::npos)
    return std::nullopt;
  type.bytes = std::stoll(size) * (kind[0] == 'U' ? kUnicodeBytes : 1);
  type.number = number_of(kind);
  type.swapped = text[0] == '>';
  type.moment = kind == "M8" || kind == "m8";
  if (type.moment && bracket + 2 < text.size())
    type.unit = text.substr(bracket + 1, text.size() - bracket - 2);
  return type;
}

std::optional<Shape> shape_of(const NpyJson& json) {
  if (json.is_number_integer()) return Shape{json.get<std::int64_t>()};
  if (!json.is_array() || json.size() > kHeaderMostDimensions) return std::nullopt;
  Shape shape;
  for (const NpyJson& size : json) {
    if (!size.is_number_integer()) return std::nullopt;
    shape.push_back(size.get<std::int64_t>());
  }
  return shape;
}

/// Returns the bytes of so many items; nullopt for more than any file has.
std::optional<std::int64_t> bytes_of(const Shape& shape, std::int64_t item) {
  std::int64_t bytes = std::max<std::int64_t>(item, 1);
  for (const std::int64_t size : shape) {
    if (size > 0 && bytes > kHeaderMostBytes / size) return std::nullopt;
    bytes *= std::max<std::int64_t>(size, 1);
  }
  return std::count(shape.begin(), shape.end(), 0) > 0 ? 0 : bytes;
}

/// The fields of a record, each as an array over the records.
class RecordFields {
 public:
  explicit RecordFields(std::string prefix) : prefix_(std::move(prefix)) {}

  /// Returns the bytes of a record; nullopt when it cannot be read.
  std::optional<std::int64_t> read(const NpyJson& descr, const std::string& path) {
    for (const NpyJson& field : descr) {
      if (!field.is_array() || field.size() < 2) return std::nullopt;
      const NpyJson& given = field[0].is_array() && field[0].size() == 2 ? field[0][1] : field[0];
      if (!given.is_string()) return std::nullopt;
      const auto shape = field.size() > 2 ? shape_of(field[2]) : Shape{};
      if (!shape || !read_field(field[1], path + given.get<std::string>(), *shape)) return std::nullopt;
    }
    return bytes_;
  }

  std::vector<StoredArray> arrays;

 private:
  bool read_field(const NpyJson& descr, const std::string& name, const Shape& shape) {
    const std::int64_t begin = bytes_;
    if (descr.is_array()) {
      const std::size_t before = arrays.size();
      if (!read(descr, name + ".")) return false;
      if (!shape.empty()) arrays.resize(before);  // arrays of records in records are omitted
      return advance(begin, shape, bytes_ - begin);
    }
    const auto type = descr.is_string() ? type_of(descr.get<std::string>()) : std::nullopt;
    if (!type) return false;
    if (type->number) add(name, shape, *type, begin);
    return advance(begin, shape, type->bytes);
  }

  bool advance(std::int64_t begin, const Shape& shape, std::int64_t item) {
    const auto bytes = bytes_of(shape, item);
    if (!bytes || *bytes > kHeaderMostBytes - begin) return false;
    bytes_ = begin + (item == 0 ? 0 : *bytes);
    return true;
  }

  void add(const std::string& name, const Shape& shape, const NumpyType& type, std::int64_t begin) {
    StoredArray stored;
    stored.array.name = prefix_ + name;
    stored.array.shape = shape;
    stored.array.unit = type.unit;
    stored.in_record = begin;
    stored.type = *type.number;
    stored.swapped = type.swapped;
    stored.is_moment = type.moment;
    stored.strides = packed_strides(shape, type.bytes, false);
    arrays.push_back(stored);
  }

  std::string prefix_;
  std::int64_t bytes_ = 0;
};

void add_issue(Issues& issues, const std::string& name, const std::string& what, Severity severity) {
  const std::string label = name.empty() ? "the array" : "\"" + shortened(name, kLongestName) + "\"";
  issues.add(make_issue("array_left_out", severity, label + " " + what, name));
}

/// Puts the dimensions of the array of records before those of the fields.
void spread(std::vector<StoredArray>& fields, const Shape& shape, std::int64_t record, bool fortran_order) {
  const std::vector<std::int64_t> strides = packed_strides(shape, record, fortran_order);
  for (StoredArray& field : fields) {
    field.array.shape.insert(field.array.shape.begin(), shape.begin(), shape.end());
    field.strides.insert(field.strides.begin(), strides.begin(), strides.end());
  }
}

std::optional<NpyJson> header_json(ContentStream& stream, std::int64_t& header_bytes) {
  std::array<char, kMagicBytes + 4> start{};
  if (stream.read(0, start.data(), start.size()) < start.size()) return std::nullopt;
  const int version = static_cast<unsigned char>(start[6]);
  if (std::memcmp(start.data(), kNpyMagic, std::strlen(kNpyMagic)) != 0 || version < 1 || version > 3)
    return std::nullopt;
  const std::size_t length_bytes = version == 1 ? 2 : 4;
  std::uint32_t length = 0;
  std::memcpy(&length, start.data() + kMagicBytes, length_bytes);
  if (length > kLongestHeader) return std::nullopt;
  header_bytes = static_cast<std::int64_t>(kMagicBytes + length_bytes + length);
  std::string text(length, '\0');
  const std::size_t got =
      stream.read(static_cast<std::int64_t>(kMagicBytes + length_bytes), text.data(), length);
  if (got < length) return std::nullopt;
  return PythonParser(text).run();
}

}  // namespace

std::optional<NpyArray> read_npy_header(ContentStream& stream, const std::string& name, Issues& issues) {
  std::int64_t header_bytes = 0;
  const auto json = header_json(stream, header_bytes);
  if (!json || !json->is_object() || !json->contains("descr") || !json->contains("shape"))
    return std::nullopt;
  const auto shape = shape_of((*json)["shape"]);
  const bool fortran_order = json->value("fortran_order", NpyJson(false)) == true;
  const NpyJson& descr = (*json)["descr"];
  if (!shape) return std::nullopt;
  NpyArray result;
  RecordFields fields(descr.is_array() && !name.empty() ? name + "." : name);
  if (descr == "|O") {
    add_issue(issues, name, "holds Python objects, and was left out; save plain arrays of numbers",
              Severity::note);
    return result;
  }
  const auto record =
      fields.read(descr.is_array() ? descr : NpyJson::array({NpyJson::array({"", descr})}), "");
  const auto bytes = record ? bytes_of(*shape, *record) : std::nullopt;
  if (!bytes) return std::nullopt;
  spread(fields.arrays, *shape, *record, fortran_order);
  for (StoredArray& stored : fields.arrays) stored.begin = header_bytes;
  const bool number = !fields.arrays.empty();
  if (!number && !shape->empty())
    add_issue(issues, name, "holds no numbers, and was left out", Severity::note);
  result.arrays = std::move(fields.arrays);
  result.bytes = header_bytes + *bytes;
  return result;
}

}  // namespace faultline
