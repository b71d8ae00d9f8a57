// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

namespace faultline {

/// How the members of a message of ROS are laid out in its bytes.
struct MessageWire {
  std::size_t begin = 0;           ///< byte from which alignment counts
  std::size_t most_alignment = 1;  ///< a value is aligned to its size, at most to this
  bool swapped = false;            ///< big-endian
  bool ends_with_nul = false;      ///< texts
};

/// Returns the layout of a message of ROS 1, which has no alignment.
inline MessageWire ros1_wire() { return {}; }

/// Returns the layout that the first four bytes of a message of ROS 2 state: plain CDR of version 1, or of
/// version 2, which aligns to 4 bytes at most; nullopt for other encodings.
inline std::optional<MessageWire> cdr_wire(std::string_view bytes) {
  constexpr std::size_t kHead = 4;
  constexpr unsigned char kBig = 0, kLittle = 1, kBig2 = 6, kLittle2 = 7;
  if (bytes.size() < kHead || bytes[0] != 0) return std::nullopt;
  const auto kind = static_cast<unsigned char>(bytes[1]);
  if (kind != kBig && kind != kLittle && kind != kBig2 && kind != kLittle2) return std::nullopt;
  const bool second = kind == kBig2 || kind == kLittle2;
  return MessageWire{kHead, second ? std::size_t{4} : sizeof(double), kind == kBig || kind == kBig2, true};
}

/// Takes the members of a message in their order. Reading past the end of the bytes gives zeros and empty
/// texts, and sets ok() to false.
class MessageBytes {
 public:
  MessageBytes(std::string_view bytes, const MessageWire& wire)
      : bytes_(bytes), wire_(wire), at_(std::min(wire.begin, bytes.size())) {}

  /// Takes a number after the bytes that align it.
  template <class T>
  T number() {
    align(sizeof(T));
    if (!has(sizeof(T))) return T{};
    char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if (wire_.swapped) std::reverse(std::begin(raw), std::end(raw));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  /// Takes a text after its length.
  std::string_view text() {
    const auto size = number<std::uint32_t>();
    const std::string_view all = raw(size);
    return wire_.ends_with_nul && !all.empty() && all.back() == '\0' ? all.substr(0, all.size() - 1) : all;
  }

  /// Takes `count` values of `size` bytes each, after the bytes that align the first.
  std::string_view values(std::size_t count, std::size_t size) {
    if (count == 0) return {};
    align(size);
    if (!ok_ || count > (bytes_.size() - at_) / size) return ok_ = false, std::string_view{};
    return raw(count * size);
  }

  /// Skips `same` if it is at this position; else returns false.
  bool passes(std::string_view same) {
    if (same.empty() || bytes_.substr(at_, same.size()) != same) return false;
    at_ += same.size();
    return true;
  }

  /// Skips the bytes that align a value of `size` bytes.
  void align(std::size_t size) {
    const std::size_t to = std::min(size, wire_.most_alignment);
    at_ = std::min(bytes_.size(), at_ + (to - (at_ - wire_.begin) % to) % to);
  }

  bool ok() const { return ok_; }
  std::size_t position() const { return at_; }
  std::size_t left() const { return bytes_.size() - at_; }
  const MessageWire& wire() const { return wire_; }

 private:
  bool has(std::size_t size) { return ok_ = ok_ && size <= bytes_.size() - at_; }

  std::string_view raw(std::size_t size) {
    if (!has(size)) return {};
    const std::string_view taken = bytes_.substr(at_, size);
    at_ += size;
    return taken;
  }

  std::string_view bytes_;
  MessageWire wire_;
  std::size_t at_;
  bool ok_ = true;
};

}  // namespace faultline
