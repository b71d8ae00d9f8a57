// SPDX-License-Identifier: MIT
#include "lib/report/html/base64.hpp"

namespace faultline {

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

}  // namespace faultline
