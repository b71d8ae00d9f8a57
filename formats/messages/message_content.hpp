// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/messages/message_definition.hpp"
#include "formats/messages/message_source.hpp"

namespace faultline {

/// Values of one array, or a single value, in a message.
struct FieldRun {
  std::size_t first = 0, count = 0;  ///< in MessageField's numbers or texts
};

/// The values of one field in a message. A field inside an array of types has a run for each element.
struct FieldContent {
  std::string path;     ///< names from the message down, such as "drives.angle"
  std::string example;  ///< the first value in the words of field_place(), such as "drives[0].angle[0]"
  bool is_text = false;
  bool is_array = false;   ///< its runs are arrays
  std::size_t arrays = 0;  ///< arrays that enclose it, itself not counted
  std::vector<double> numbers;
  std::vector<std::string_view> texts;
  std::vector<FieldRun> runs;
  std::vector<std::uint32_t> places;  ///< by run: its place in each of the enclosing arrays

  /// Longest array that is kept; a joint signal has a few values, a picture has millions.
  static constexpr std::size_t kMostValues = 1 << 12;
  /// Largest number of runs in one message.
  static constexpr std::size_t kMostRuns = 1 << 12;
  /// Begins a run at a place in the enclosing arrays; false if there are too many.
  bool begin_run(const std::vector<std::uint32_t>& place);
};

/// All values of a message, but those of arrays with more than 4096 values, such as pictures. Texts are valid
/// as long as the bytes of the message and until the next one is decoded.
struct MessageContent {
  std::vector<FieldContent> fields;

  /// Removes the values and keeps the fields.
  void clear_values();
  /// Returns the field of this path; null for none.
  const FieldContent* find(std::string_view path) const;
  /// Returns the numbers of the first array, or the first value, under this path; empty for none.
  std::vector<double> numbers(std::string_view path) const;
  /// Returns the texts of the first array under this path; empty for none.
  std::vector<std::string> texts(std::string_view path) const;
};

/// A value of a message by its name, such as "q[3]" or "interface_values[0].values[2]", with indices from 0.
struct FieldPlace {
  std::string path;                    ///< without indices
  std::vector<std::uint32_t> indices;  ///< from the outermost array on
};

/// Returns the place that a text names; nullopt for a text that names none.
std::optional<FieldPlace> field_place(std::string_view text);

/// Returns the number at a place; NaN if the message has none there.
double number_at(const MessageContent& content, const FieldPlace& place);

/// Returns the stamp of the header in ns; 0 for a message without one.
std::int64_t stamp_of(const MessageContent& content);

/// Decodes all values of the messages of a topic.
class ContentDecoder {
 public:
  virtual ~ContentDecoder() = default;
  /// Replaces `content`, reusing its storage; false when the bytes are not a complete message.
  virtual bool decode(std::string_view bytes, MessageContent& content) = 0;
};

/// Returns a decoder for messages of ROS 1 and ROS 2 whose definition the recording states or is known, and
/// for JSON; null for others.
std::unique_ptr<ContentDecoder> content_decoder(const Topic& topic);

/// Returns a decoder for JSON objects.
std::unique_ptr<ContentDecoder> json_content_decoder();

}  // namespace faultline
