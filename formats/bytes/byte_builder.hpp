// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace faultline {

/// Appends little-endian values to bytes.
class ByteBuilder {
 public:
  template <std::unsigned_integral T>
  ByteBuilder& put(T value) {
    static_assert(std::endian::native == std::endian::little);
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes_.append(raw, sizeof raw);
    return *this;
  }
  ByteBuilder& put_bytes(std::string_view bytes) {
    bytes_.append(bytes);
    return *this;
  }
  /// Appends the text after its length in 32 bits.
  ByteBuilder& put_text(std::string_view text) {
    return put(static_cast<std::uint32_t>(text.size())).put_bytes(text);
  }
  const std::string& bytes() const { return bytes_; }
  void clear() { bytes_.clear(); }

 private:
  std::string bytes_;
};

}  // namespace faultline
