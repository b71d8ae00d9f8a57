// SPDX-License-Identifier: MIT
#pragma once

#include <zlib.h>

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace faultline {

/// Returns the CRC-32 of zlib over bytes that follow others whose checksum is `before`.
inline std::uint32_t crc32_of(std::string_view bytes, std::uint32_t before = 0) {
  if (bytes.empty()) return before;
  return static_cast<std::uint32_t>(
      ::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// Takes little-endian values from the front of bytes. Reading past their end gives zeros and empty text, and
/// sets ok() to false.
class ByteCursor {
 public:
  explicit ByteCursor(std::string_view bytes) : bytes_(bytes) {}

  template <std::unsigned_integral T>
  T take() {
    static_assert(std::endian::native == std::endian::little);
    const std::string_view raw = bytes(sizeof(T));
    T value{};
    if (raw.size() == sizeof value) std::memcpy(&value, raw.data(), sizeof value);
    return value;
  }
  std::string_view bytes(std::uint64_t size) {
    if (size > bytes_.size() - at_) {
      ok_ = false;
      at_ = bytes_.size();
      return {};
    }
    const std::string_view taken = bytes_.substr(at_, size);
    at_ += size;
    return taken;
  }
  /// Bytes that follow their number, which is of type T.
  template <std::unsigned_integral T = std::uint32_t>
  std::string_view text() {
    return bytes(take<T>());
  }
  bool ok() const { return ok_; }
  std::size_t position() const { return at_; }
  std::string_view rest() const { return bytes_.substr(at_); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

/// Appends a little-endian value to bytes.
template <std::unsigned_integral T>
void put_number(std::string& bytes, T value) {
  static_assert(std::endian::native == std::endian::little);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Appends little-endian values to bytes.
class ByteBuilder {
 public:
  template <std::unsigned_integral T>
  ByteBuilder& put(T value) {
    put_number(bytes_, value);
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
