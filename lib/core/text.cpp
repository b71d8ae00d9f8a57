// SPDX-License-Identifier: MIT
#include "lib/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "lib/core/utf8.hpp"

namespace faultline {
namespace {

int characters(const std::string& text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

/// A control character of Unicode's second block, two bytes in UTF-8.
bool is_c1(const std::string& text, std::size_t i) {
  return text[i] == '\xc2' && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0;
}

}  // namespace

std::string printable(std::string_view text) {
  const std::string valid = valid_utf8(text);
  std::string safe;
  for (std::size_t i = 0; i < valid.size(); ++i) {
    const auto c = static_cast<unsigned char>(valid[i]);
    if (c == '\n' || c == '\r' || c == '\t')
      safe += ' ';
    else if (c < 0x20 || c == 0x7f)
      safe += '?';
    else if (is_c1(valid, i))
      safe += '?', ++i;
    else
      safe += valid[i];
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
