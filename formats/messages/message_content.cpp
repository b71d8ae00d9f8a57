// SPDX-License-Identifier: MIT
#include "formats/messages/message_content.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "formats/messages/message_bytes.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {
namespace {

using ContentJson = nlohmann::json;

/// Longest array that is kept; a joint signal has a few values, a picture has millions.
constexpr std::size_t kMostValues = 1 << 12;
/// Largest number of runs of a field in one message.
constexpr std::size_t kMostRuns = 1 << 12;
/// Largest JSON message in bytes, and number and depth of its fields.
constexpr std::size_t kLongestContentJson = 1 << 20;
constexpr std::size_t kMostJsonFields = 1 << 12;
constexpr std::size_t kDeepestJson = 16;
/// Bytes that may follow the last member of a message, which pad it.
constexpr std::size_t kPadding = 4;
constexpr std::int64_t kStampSecond_ns = 1'000'000'000;
/// Upper limit of the seconds of a stamp; more would not fit 64 bits of nanoseconds.
constexpr double kMostStampSeconds = 9e9;

void clear_values(MessageContent& content) {
  for (FieldContent& field : content.fields) {
    field.numbers.clear();
    field.texts.clear();
    field.runs.clear();
    field.places.clear();
  }
}

/// Begins a run of a field at a place in the arrays that enclose it; false when it has too many.
bool begin_run(FieldContent& field, const std::vector<std::uint32_t>& place) {
  if (field.runs.size() >= kMostRuns) return false;
  field.runs.push_back({field.is_text ? field.texts.size() : field.numbers.size(), 0});
  field.places.insert(field.places.end(), place.begin(), place.end());
  return true;
}

double taken_number(MessageBytes& bytes, MessageValue value) {
  switch (value) {
    case MessageValue::boolean:
    case MessageValue::uint8:
      return bytes.number<std::uint8_t>();
    case MessageValue::int8:
      return bytes.number<std::int8_t>();
    case MessageValue::int16:
      return bytes.number<std::int16_t>();
    case MessageValue::uint16:
      return bytes.number<std::uint16_t>();
    case MessageValue::int32:
      return bytes.number<std::int32_t>();
    case MessageValue::uint32:
      return bytes.number<std::uint32_t>();
    case MessageValue::int64:
      return static_cast<double>(bytes.number<std::int64_t>());
    case MessageValue::uint64:
      return static_cast<double>(bytes.number<std::uint64_t>());
    case MessageValue::float32:
      return bytes.number<float>();
    case MessageValue::float64:
      return bytes.number<double>();
    case MessageValue::text:
      break;
  }
  return kNan;
}

/// Decodes messages of one definition.
class DefinedContent {
 public:
  explicit DefinedContent(MessageDefinition definition) : definition_(std::move(definition)) {
    add_fields(0, "", "", 0);
  }

  /// Fills the content; false when the bytes do not hold all members. With `whole`, nothing may follow them.
  bool decode(MessageBytes bytes, bool whole, MessageContent& content) {
    if (content.fields.size() != fields_.size()) content.fields = fields_;
    clear_values(content);
    place_.clear();
    std::size_t next = 0;
    return take_group(bytes, 0, next, content) && (!whole || bytes.left() < kPadding);
  }

 private:
  /// Lists the fields of a group in the order in which take_group() meets them.
  void add_fields(int group, const std::string& before, const std::string& example_before,
                  std::size_t arrays) {
    for (const MessageField& field : definition_.groups[static_cast<std::size_t>(group)].fields) {
      const std::string path = before + field.name;
      const bool is_array = field.count != MessageCount::one;
      const std::string example = example_before + field.name + (is_array ? "[0]" : "");
      if (field.group >= 0) {
        add_fields(field.group, path + ".", example + ".", arrays + is_array);
        continue;
      }
      fields_.push_back({});
      fields_.back().path = path;
      fields_.back().example = example;
      fields_.back().is_text = field.value == MessageValue::text;
      fields_.back().is_array = is_array;
      fields_.back().arrays = arrays;
    }
  }

  /// Takes a group; `next` is the index of its first field and then of the first one behind it.
  bool take_group(MessageBytes& bytes, int group, std::size_t& next, MessageContent& content) {
    for (const MessageField& field : definition_.groups[static_cast<std::size_t>(group)].fields) {
      const std::size_t count = count_of(field, bytes);
      if (!bytes.ok()) return false;
      if (field.group < 0) {
        if (!take_values(bytes, field, count, content.fields[next])) return false;
        ++next;
      } else if (field.count == MessageCount::one) {
        if (!take_group(bytes, field.group, next, content)) return false;
      } else if (!take_elements(bytes, field, count, next, content)) {
        return false;
      }
    }
    return bytes.ok();
  }

  static std::size_t count_of(const MessageField& field, MessageBytes& bytes) {
    if (field.count == MessageCount::one) return 1;
    return field.count == MessageCount::fixed ? field.size : bytes.number<std::uint32_t>();
  }

  /// Takes the elements of an array of groups.
  bool take_elements(MessageBytes& bytes, const MessageField& field, std::size_t count, std::size_t& next,
                     MessageContent& content) {
    const std::size_t first = next;
    next = first + fields_in(field.group);
    // An element without bytes would let a few bytes ask for any number of steps.
    if (count > bytes.left()) return count == 0;
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t at = first;
      place_.push_back(static_cast<std::uint32_t>(i));
      const bool taken = take_group(bytes, field.group, at, content);
      place_.pop_back();
      if (!taken) return false;
    }
    return true;
  }

  /// Returns the number of fields of a group with those of the groups in it.
  std::size_t fields_in(int group) const {
    std::size_t count = 0;
    for (const MessageField& field : definition_.groups[static_cast<std::size_t>(group)].fields)
      count += field.group < 0 ? 1 : fields_in(field.group);
    return count;
  }

  /// Takes single values or an array of them.
  bool take_values(MessageBytes& bytes, const MessageField& field, std::size_t count, FieldContent& content) {
    const std::size_t size = bytes_of(field.value);
    if (size > 0 && (count > kMostValues || content.runs.size() >= kMostRuns)) {
      bytes.values(count, size);
      return bytes.ok();
    }
    if (count > bytes.left() && count > 0) return false;
    const bool kept = begin_run(content, place_);
    for (std::size_t i = 0; i < count && bytes.ok(); ++i) {
      if (field.value != MessageValue::text) {
        content.numbers.push_back(taken_number(bytes, field.value));
      } else if (const std::string_view text = bytes.text(); kept) {
        content.texts.push_back(text);
      }
    }
    if (kept) content.runs.back().count = count;
    return bytes.ok();
  }

  MessageDefinition definition_;
  std::vector<FieldContent> fields_;  ///< without values
  std::vector<std::uint32_t> place_;  ///< in the arrays of groups that are being taken
};

/// Decodes messages of ROS. Where several versions of a type are known, each message has the first version
/// that takes all of its bytes.
class RosContentDecoder : public ContentDecoder {
 public:
  RosContentDecoder(std::vector<MessageDefinition> versions, bool cdr) : cdr_(cdr) {
    for (MessageDefinition& version : versions) versions_.emplace_back(std::move(version));
  }

  bool decode(std::string_view bytes, MessageContent& content) override {
    const std::optional<MessageWire> wire = cdr_ ? cdr_wire(bytes) : ros1_wire();
    if (!wire) return false;
    // Arrays of types have a further length in the second version of CDR, which is not read.
    const bool is_second = cdr_ && wire->most_alignment < sizeof(double);
    const bool whole = versions_.size() > 1 || is_second;
    for (std::size_t tried = 0; tried < versions_.size(); ++tried) {
      const std::size_t version = (last_ + tried) % versions_.size();
      if (!versions_[version].decode(MessageBytes(bytes, *wire), whole, content)) {
        content.fields.clear();
        continue;
      }
      last_ = version;
      return true;
    }
    return false;
  }

 private:
  std::vector<DefinedContent> versions_;
  bool cdr_;
  std::size_t last_ = 0;  ///< version of the last message
};

/// Decodes JSON objects; their fields are found anew in each message.
class JsonContentDecoder : public ContentDecoder {
 public:
  bool decode(std::string_view bytes, MessageContent& content) override {
    clear_values(content);
    place_.clear();
    if (bytes.size() > kLongestContentJson) return false;
    message_ = ContentJson::parse(bytes, nullptr, false);
    if (!message_.is_object()) return false;
    return add(message_, "", "", content);
  }

 private:
  FieldContent* field_of(const std::string& path, const std::string& example, bool is_text, bool is_array,
                         MessageContent& content) {
    const auto [known, is_new] = index_of_.emplace(path, content.fields.size());
    if (is_new && content.fields.size() >= kMostJsonFields) return nullptr;
    if (is_new) content.fields.push_back({path, example, is_text, is_array, place_.size(), {}, {}, {}, {}});
    FieldContent& field = content.fields[known->second];
    const bool fits = field.is_text == is_text && field.is_array == is_array && field.arrays == place_.size();
    return fits && begin_run(field, place_) ? &field : nullptr;
  }

  static std::string below(const std::string& path, const std::string& name) {
    return path.empty() ? name : path + "." + name;
  }

  static void put(const ContentJson& value, FieldContent& field) {
    if (field.is_text)
      field.texts.push_back(value.is_string() ? std::string_view(value.get_ref<const std::string&>())
                                              : std::string_view());
    else
      field.numbers.push_back(value.is_number() ? value.get<double>()
                                                : (value.is_boolean() ? double(value.get<bool>()) : kNan));
    ++field.runs.back().count;
  }

  /// Adds a value under its path; false when the message is deeper than any.
  bool add(const ContentJson& value, const std::string& path, const std::string& example,
           MessageContent& content) {
    if (place_.size() > kDeepestJson ||
        std::count(path.begin(), path.end(), '.') > std::ptrdiff_t{kDeepestJson})
      return false;
    if (value.is_object()) {
      for (const auto& [name, member] : value.items())
        if (!add(member, below(path, name), below(example, name), content)) return false;
      return true;
    }
    if (!value.is_array()) {
      if (FieldContent* field = field_of(path, example, value.is_string(), false, content))
        put(value, *field);
      return true;
    }
    if (!value.empty() && value.front().is_structured()) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        place_.push_back(static_cast<std::uint32_t>(i));
        const bool added = add(value[i], path, example + "[0]", content);
        place_.pop_back();
        if (!added) return false;
      }
      return true;
    }
    if (value.empty() || value.size() > kMostValues) return true;
    if (FieldContent* field = field_of(path, example + "[0]", value.front().is_string(), true, content))
      for (const ContentJson& element : value) put(element, *field);
    return true;
  }

  ContentJson message_;
  std::map<std::string, std::size_t> index_of_;  ///< of a path, in the content
  std::vector<std::uint32_t> place_;
};

}  // namespace

const FieldContent* MessageContent::find(std::string_view path) const {
  for (const FieldContent& field : fields)
    if (field.path == path) return &field;
  return nullptr;
}

std::vector<double> MessageContent::numbers(std::string_view path) const {
  const FieldContent* field = find(path);
  if (!field || field->is_text || field->runs.empty()) return {};
  const auto first = field->numbers.begin() + static_cast<std::ptrdiff_t>(field->runs.front().first);
  return {first, first + static_cast<std::ptrdiff_t>(field->runs.front().count)};
}

std::vector<std::string> MessageContent::texts(std::string_view path) const {
  const FieldContent* field = find(path);
  if (!field || !field->is_text || field->runs.empty()) return {};
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < field->runs.front().count; ++i)
    texts.emplace_back(field->texts[field->runs.front().first + i]);
  return texts;
}

std::optional<FieldPlace> field_place(std::string_view text) {
  FieldPlace place;
  while (!text.empty()) {
    const auto bracket = text.find('[');
    place.path += text.substr(0, bracket);
    if (bracket == std::string_view::npos) break;
    text.remove_prefix(bracket + 1);
    const auto end = text.find(']');
    std::uint32_t index = 0;
    const char* last = text.data() + std::min(end, text.size());
    const auto [read, error] = std::from_chars(text.data(), last, index);
    if (end == std::string_view::npos || error != std::errc{} || read != last) return std::nullopt;
    place.indices.push_back(index);
    text.remove_prefix(end + 1);
  }
  return place.path.empty() ? std::nullopt : std::optional(place);
}

double number_at(const MessageContent& content, const FieldPlace& place) {
  const FieldContent* field = content.find(place.path);
  if (!field || field->is_text || place.indices.size() != field->arrays + field->is_array) return kNan;
  const std::size_t within = field->is_array ? place.indices.back() : 0;
  for (std::size_t r = 0; r < field->runs.size(); ++r) {
    const auto at = field->places.begin() + static_cast<std::ptrdiff_t>(r * field->arrays);
    if (!std::equal(at, at + static_cast<std::ptrdiff_t>(field->arrays), place.indices.begin())) continue;
    return within < field->runs[r].count ? field->numbers[field->runs[r].first + within] : kNan;
  }
  return kNan;
}

std::int64_t stamp_of(const MessageContent& content) {
  const auto first_of = [&](std::initializer_list<const char*> names) {
    for (const char* name : names)
      if (const auto numbers = content.numbers(name); !numbers.empty()) return numbers.front();
    return 0.0;
  };
  const double seconds = first_of({"header.stamp.sec", "header.stamp.secs"});
  const double nanoseconds = first_of({"header.stamp.nanosec", "header.stamp.nsec", "header.stamp.nsecs"});
  if (!(seconds >= 0.0 && seconds < kMostStampSeconds && nanoseconds >= 0.0 &&
        nanoseconds < kMostStampSeconds))
    return 0;
  return static_cast<std::int64_t>(seconds) * kStampSecond_ns + static_cast<std::int64_t>(nanoseconds);
}

std::unique_ptr<ContentDecoder> content_decoder(const Topic& topic) {
  if (topic.encoding == "json") return std::make_unique<JsonContentDecoder>();
  const bool cdr = topic.encoding == "cdr";
  if (!cdr && topic.encoding != "ros1" && topic.encoding != "ros1msg") return nullptr;
  std::vector<MessageDefinition> versions;
  if (auto stated = parse_definition(topic.type, topic.definition); stated && !topic.definition.empty())
    versions.push_back(*std::move(stated));
  else
    versions = known_definitions(topic.type);
  if (versions.empty()) return nullptr;
  return std::make_unique<RosContentDecoder>(std::move(versions), cdr);
}

}  // namespace faultline
