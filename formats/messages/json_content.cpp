// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "formats/messages/message_content.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {
namespace {

using ContentJson = nlohmann::json;

/// Largest JSON message in bytes, and number and depth of its fields.
constexpr std::size_t kLongestContentJson = 1 << 20;
constexpr std::size_t kMostJsonFields = 1 << 12;
constexpr std::size_t kDeepestJson = 16;

/// Decodes JSON objects; their fields are found anew in each message.
class JsonContentDecoder : public ContentDecoder {
 public:
  bool decode(std::string_view bytes, MessageContent& content) override {
    content.clear_values();
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
    return fits && field.begin_run(place_) ? &field : nullptr;
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
    if (value.empty() || value.size() > FieldContent::kMostValues) return true;
    if (FieldContent* field = field_of(path, example + "[0]", value.front().is_string(), true, content))
      for (const ContentJson& element : value) put(element, *field);
    return true;
  }

  ContentJson message_;
  std::map<std::string, std::size_t> index_of_;  ///< of a path, in the content
  std::vector<std::uint32_t> place_;
};

}  // namespace

std::unique_ptr<ContentDecoder> json_content_decoder() { return std::make_unique<JsonContentDecoder>(); }

}  // namespace faultline
