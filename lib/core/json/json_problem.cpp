// SPDX-License-Identifier: MIT
#include "lib/core/json/json_problem.hpp"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

namespace faultline {
namespace {

constexpr std::size_t kLongestJsonWord = 24;
constexpr int kNumberOverflow = 406;  // of nlohmann::json

bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'; }

/// The word, or else the character, around byte `at`.
std::string word_at(std::string_view text, std::size_t at) {
  std::size_t begin = at, end = at;
  while (begin > 0 && at - begin < kLongestJsonWord && is_of_word(text[begin - 1])) --begin;
  while (end < text.size() && end - begin < kLongestJsonWord && is_of_word(text[end])) ++end;
  return std::string(text.substr(begin, std::max<std::size_t>(end - begin, 1)));
}

std::string place_words(std::string_view text, std::size_t byte) {
  if (byte == 0 || byte > text.size()) return "it ends too early; restore it from a copy";
  const std::size_t at = byte - 1;
  const std::string_view before = text.substr(0, at);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t line_begin = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  const std::string word = word_at(text, at);
  std::string sentence = "line " + std::to_string(line) + ", column " + std::to_string(at - line_begin + 1) +
                         ": \"" + word + "\" cannot stand there in JSON";
  for (const char* number : {"Infinity", "-Infinity", "NaN", "nan", "inf", "-inf"})
    if (word == number) sentence += "; write a finite number, or null for one that is not known";
  return sentence;
}

/// Without the name and number that the library gives its messages.
std::string plain(const std::string& message) {
  const std::size_t end = message.starts_with('[') ? message.find("] ") : std::string::npos;
  return end == std::string::npos ? message : message.substr(end + 2);
}

}  // namespace

std::string json_problem(const std::exception& error, std::string_view text) {
  if (const auto* no_json = dynamic_cast<const nlohmann::json::parse_error*>(&error))
    return place_words(text, no_json->byte);
  const auto* beyond = dynamic_cast<const nlohmann::json::out_of_range*>(&error);
  const std::string message = plain(error.what());
  if (beyond && beyond->id == kNumberOverflow) {
    const std::size_t quote = message.find('\'');
    const std::string number = quote == std::string::npos
                                   ? std::string("a number")
                                   : message.substr(quote + 1, message.rfind('\'') - quote - 1);
    return number +
           " is larger than any number that is kept; write a finite one, or null for one that is not known";
  }
  return message;
}

}  // namespace faultline
