// SPDX-License-Identifier: MIT
#include "lib/report/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "lib/core/utf8.hpp"

namespace faultline {
namespace {

const char* code_of(Paint paint) {
  switch (paint) {
    case Paint::bold:
      return "1";
    case Paint::dim:
      return "2";
    case Paint::red:
      return "1;31";
    case Paint::yellow:
      return "33";
    case Paint::green:
      return "1;32";
  }
  return "0";
}

int characters(const std::string& text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

/// A control character of Unicode's second block, two bytes in UTF-8.
bool is_c1(const std::string& text, std::size_t i) {
  return text[i] == '\xc2' && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0;
}

}  // namespace

std::string painted(const std::string& text, Paint paint, bool color) {
  return color ? fmt::format("\x1b[{}m{}\x1b[0m", code_of(paint), text) : text;
}

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

std::string time_text(double time_s, double sample_period_s) {
  if (!std::isfinite(time_s)) return "unknown";
  const bool known = std::isfinite(sample_period_s) && sample_period_s > 0.0;
  const int decimals =
      known ? std::clamp(static_cast<int>(std::ceil(-std::log10(sample_period_s))), 1, 6) : 3;
  return fmt::format("{:.{}f} s", time_s, std::max(decimals, 3));
}

double time_zero(double start_s) { return std::abs(start_s) >= 1e5 ? std::floor(start_s) : 0.0; }

std::string value_text(double value) {
  if (std::isnan(value)) return "-";
  return std::abs(value) >= 1000.0 && std::abs(value) < 1e7 ? fmt::format("{:.0f}", value)
                                                            : fmt::format("{:.3g}", value);
}

}  // namespace faultline
