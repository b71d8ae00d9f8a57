// SPDX-License-Identifier: MIT
#include "lib/report/html/source_hash.hpp"

#include <cstdint>
#include <vector>

#include "lib/core/hash.hpp"
#include "lib/report/html/base64.hpp"

namespace faultline {

std::string source_hash(std::string_view content) {
  const std::string hex = sha256_hex(content);
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return "'sha256-" + base64(bytes) + "'";
}

}  // namespace faultline
