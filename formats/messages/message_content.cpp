// SPDX-License-Identifier: MIT
#include "formats/messages/message_content.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "formats/messages/message_bytes.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {
namespace {

/// Bytes that may follow the last member of a message, which pad it.
constexpr std::size_t kPadding = 4;
constexpr std::int64_t kStampSecond_ns = 1'000'000'000;
/// Upper limit of the seconds of a stamp; more would not fit 64 bits of nanoseconds.
constexpr double kMostStampSeconds = 9e9;

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
    content.clear_values();
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
    if (size > 0 && (count > FieldContent::kMostValues || content.runs.size() >= FieldContent::kMostRuns)) {
      bytes.values(count, size);
      return bytes.ok();
    }
    if (count > bytes.left() && count > 0) return false;
    const bool kept = content.begin_run(place_);
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

}  // namespace

bool FieldContent::begin_run(const std::vector<std::uint32_t>& place) {
  if (runs.size() >= kMostRuns) return false;
  runs.push_back({is_text ? texts.size() : numbers.size(), 0});
  places.insert(places.end(), place.begin(), place.end());
  return true;
}

void MessageContent::clear_values() {
  for (FieldContent& field : fields) {
    field.numbers.clear();
    field.texts.clear();
    field.runs.clear();
    field.places.clear();
  }
}

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
  if (topic.encoding == "json") return json_content_decoder();
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
