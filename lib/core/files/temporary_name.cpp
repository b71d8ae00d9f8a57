// SPDX-License-Identifier: MIT
#include "lib/core/files/temporary_name.hpp"

#include <fmt/format.h>
#include <limits.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <random>

#include "lib/core/hash.hpp"

namespace faultline {
namespace {

constexpr std::string_view kMark = ".partial-";
constexpr std::size_t kMachineDigits = 8, kRandomDigits = 16;
constexpr std::size_t kTail = kMark.size() + kMachineDigits + kRandomDigits;

const std::string& machine() {
  static const std::string digits = [] {
    std::array<char, HOST_NAME_MAX + 1> name{};
    ::gethostname(name.data(), name.size() - 1);
    return sha256_hex(name.data()).substr(0, kMachineDigits);
  }();
  return digits;
}

std::uint64_t random_number() {
  thread_local std::random_device entropy;
  return std::uint64_t{entropy()} << 32 | entropy();
}

bool is_hexadecimal(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

/// Returns the text behind the mark; empty without one.
std::string_view tail_of(std::string_view name) {
  const auto mark = name.rfind(kMark);
  return mark == std::string_view::npos ? std::string_view() : name.substr(mark + kMark.size());
}

}  // namespace

std::string temporary_name(const std::string& path) {
  const std::filesystem::path place(path);
  const std::string name = place.filename().string().substr(0, NAME_MAX - kTail);
  return (place.parent_path() / fmt::format("{}{}{}{:016x}", name, kMark, machine(), random_number()))
      .string();
}

TemporaryKind temporary_kind(std::string_view name) {
  const std::string_view tail = tail_of(name);
  if (tail.size() != kMachineDigits + kRandomDigits || !is_hexadecimal(tail)) return TemporaryKind::none;
  return tail.substr(0, kMachineDigits) == machine() ? TemporaryKind::this_machine
                                                     : TemporaryKind::other_machine;
}

bool is_temporary_name(std::string_view name) { return temporary_kind(name) != TemporaryKind::none; }

}  // namespace faultline
