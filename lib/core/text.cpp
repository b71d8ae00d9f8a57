// SPDX-License-Identifier: MIT
#include "lib/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "lib/core/utf8.hpp"

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
  const std::string valid = valid_utf8(text);
  std::string safe;
  for (std::size_t i = 0; i < valid.size();) {
    const std::size_t command = command_length(valid, i);
    const bool blank = valid[i] == '\n' || valid[i] == '\r' || valid[i] == '\t';
    safe += blank ? ' ' : command > 0 ? '?' : valid[i];
    i += std::max<std::size_t>(command, 1);
  }
  return safe;
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

}  // namespace faultline
