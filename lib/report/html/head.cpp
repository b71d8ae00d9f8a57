// SPDX-License-Identifier: MIT
#include "lib/report/html/head.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "lib/core/hash.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

std::string policy(bool with_script) {
  std::string scripts = "'none'";
  if (with_script) scripts = source_hash(dygraphs_script()) + " " + source_hash(page_script());
  return fmt::format(
      "default-src 'none'; script-src {}; style-src {} {}; base-uri 'none'; form-action 'none'", scripts,
      source_hash(page_style()), source_hash(dygraphs_style()));
}

}  // namespace

std::string base64(std::span<const std::uint8_t> bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  std::size_t out = 0;
  for (std::size_t i = 0; i < bytes.size(); i += 3, out += 4) {
    const std::size_t left = bytes.size() - i;
    const std::uint32_t group = static_cast<std::uint32_t>(bytes[i]) << 16 |
                                (left > 1 ? static_cast<std::uint32_t>(bytes[i + 1]) << 8 : 0u) |
                                (left > 2 ? bytes[i + 2] : 0u);
    text[out] = kDigits[group >> 18];
    text[out + 1] = kDigits[group >> 12 & 63];
    if (left > 1) text[out + 2] = kDigits[group >> 6 & 63];
    if (left > 2) text[out + 3] = kDigits[group & 63];
  }
  return text;
}

std::string source_hash(std::string_view content) {
  const std::string hex = sha256_hex(content);
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return "'sha256-" + base64(bytes) + "'";
}

std::string html_head(const std::string& title, bool with_script) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "http-equiv=\"Content-Security-Policy\" content=\"{}\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n",
      policy(with_script), escaped_markup(title));
  if (with_script) text += fmt::format("<style>{}</style>\n", dygraphs_style());
  text += fmt::format("<style>{}</style>\n", page_style());  // after it, so that ours stands
  return text + "</head>\n";
}

}  // namespace faultline
