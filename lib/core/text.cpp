// SPDX-License-Identifier: MIT
#include "lib/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>
#include <string_view>

namespace faultline {
namespace {

constexpr std::size_t kLongestWord = 500;       // characters; longer than a path should be
constexpr std::size_t kLongestSentence = 4000;  // characters

bool starts_character(char c) { return (c & 0xc0) != 0x80; }

int characters(std::string_view text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), starts_character));
}

/// Returns the byte at which character `number` (from 0) of valid UTF-8 begins.
std::size_t byte_of(std::string_view text, std::size_t number) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (starts_character(text[i]) && number-- == 0) return i;
  return text.size();
}

/// Whether it is one of U+200E, U+200F, U+202A to U+202E and U+2066 to U+2069, whose first byte is E2.
bool turns_direction(unsigned char second, unsigned char third) {
  if (second == 0x81) return third >= 0xa6 && third <= 0xa9;
  return second == 0x80 && (third == 0x8e || third == 0x8f || (third >= 0xaa && third <= 0xae));
}

/// Returns `text`, which is printable() already, in at most `most` characters.
std::string cut(std::string_view text, std::size_t most) {
  const auto length = static_cast<std::size_t>(characters(text));
  if (length <= most) return std::string(text);
  const std::size_t front = 2 * most / 3;
  const std::size_t back = byte_of(text, length - (most - front));
  return fmt::format("{}...({} characters)...{}", text.substr(0, byte_of(text, front)), length,
                     text.substr(back));
}

/// Returns the length of a code as painted() writes it (ESC [ digits m), 0 for none.
std::size_t paint_length(std::string_view text) {
  if (!text.starts_with("\x1b[")) return 0;
  const auto end = text.find_first_not_of("0123456789;", 2);
  return end != std::string_view::npos && text[end] == 'm' ? end + 1 : 0;
}

unsigned char byte_at(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
}

/// Returns the length of the character at `i`, 0 for none (RFC 3629: no overlong forms, no surrogates).
std::size_t character_length(std::string_view text, std::size_t i) {
  const unsigned char first = byte_at(text, i);
  if (first < 0x80) return 1;
  const std::size_t length = first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte_at(text, i + k) & 0xc0) != 0x80) return 0;
  const unsigned char second = byte_at(text, i + 1);
  const bool overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  const bool outside = (first == 0xed && second > 0x9f) || (first == 0xf4 && second > 0x8f);
  return overlong || outside ? 0 : length;
}

/// In the order of Paint.
constexpr std::array kCodes{"1", "2", "31", "33", "32", "1;31", "1;32"};
static_assert(kCodes.size() == static_cast<std::size_t>(Paint::bold_green) + 1);

constexpr std::string_view kMarks = "&<>\"'\n\t";
constexpr std::array kEntities{"&amp;", "&lt;", "&gt;", "&quot;", "&apos;", "&#10;", "&#9;"};  // of kMarks

}  // namespace

std::size_t command_length(std::string_view valid, std::size_t i) {
  const auto byte = [&](std::size_t k) {
    return k < valid.size() ? static_cast<unsigned char>(valid[k]) : static_cast<unsigned char>(0);
  };
  if (byte(i) < 0x20 || byte(i) == 0x7f) return 1;
  if (byte(i) == 0xc2 && byte(i + 1) < 0xa0) return 2;  // the control characters of Unicode's second block
  return byte(i) == 0xe2 && turns_direction(byte(i + 1), byte(i + 2)) ? 3 : 0;
}

std::string printable(std::string_view text) {
  std::string line = outgoing(text, false);
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

std::string shortened(std::string_view text, std::size_t most) { return cut(printable(text), most); }

std::string brief(std::string_view text) {
  const std::string line = printable(text);
  std::string all;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(' ', begin), line.size());
    if (begin > 0) all += ' ';
    all += cut(std::string_view(line).substr(begin, end - begin), kLongestWord);
    begin = end + 1;
  }
  return cut(all, kLongestSentence);
}

std::string outgoing(std::string_view text, bool color) {
  const std::string valid = valid_utf8(text);
  const std::string_view all(valid);
  std::string safe;
  for (std::size_t i = 0; i < valid.size();) {
    const std::size_t paint = color ? paint_length(all.substr(i)) : 0;
    const std::size_t command = paint > 0 || valid[i] == '\n' ? 0 : command_length(all, i);
    if (command > 0)
      safe += valid[i] == '\t' || valid[i] == '\r' ? ' ' : '?';
    else
      safe += all.substr(i, std::max<std::size_t>(paint, 1));
    i += std::max({command, paint, std::size_t{1}});
  }
  return safe;
}

std::string wrapped(const std::string& text, const std::string& indent, int width) {
  std::istringstream words(text);
  std::string all, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && characters(indent) + characters(line) + 1 + characters(word) > width) {
      all += indent + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return line.empty() ? all : all + indent + line + "\n";
}

std::string counted(long long count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string valid_utf8(std::string_view text) {
  std::string valid;
  valid.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    valid += length ? text.substr(i, length) : std::string_view("\xef\xbf\xbd");
    i += length ? length : 1;
  }
  return valid;
}

std::string painted(std::string_view text, Paint paint, bool color) {
  return color ? fmt::format("\x1b[{}m{}\x1b[0m", kCodes[static_cast<std::size_t>(paint)], text)
               : std::string(text);
}

std::string escaped_markup(std::string_view text) {
  const std::string valid = valid_utf8(text);
  std::string escaped;
  for (std::size_t i = 0; i < valid.size();) {
    const std::size_t command = command_length(valid, i);
    if (const std::size_t mark = kMarks.find(valid[i]); mark != std::string_view::npos)
      escaped += kEntities[mark];
    else
      escaped += command > 0 ? '?' : valid[i];
    i += std::max<std::size_t>(command, 1);
  }
  return escaped;
}

}  // namespace faultline
