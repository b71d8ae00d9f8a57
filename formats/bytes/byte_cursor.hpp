// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace faultline {

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

}  // namespace faultline
